// ARAP written down plainly, with dense matrices: what the fast solver must agree with.
#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "pliant/geometry/shape.h"

namespace pliant::test {

/// Half the cotangent of the corner at c, by trigonometry.
inline double half_cotangent(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return 0.5 / std::tan(std::acos((a - c).normalized().dot((b - c).normalized())));
}

/// Rotations and positions in turns until nothing changes.
class ArapReference {
 public:
  struct Item {
    Index cell, a, b;
    double weight;
  };

  ArapReference(const Shape& shape, bool rims) : rest_(shape.points()) {
    const Index n = static_cast<Index>(rest_.cols());
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, n);
    for (const auto t : shape.triangles().colwise()) {
      for (int c = 0; c < 3; ++c) {
        const Index a = t[(c + 1) % 3], b = t[(c + 2) % 3];
        const double w = half_cotangent(rest_.col(a), rest_.col(b), rest_.col(t[c]));
        weights(a, b) += w;
        weights(b, a) += w;
        if (!rims) continue;
        for (Index cell : t) items_.push_back({cell, a, b, w});
      }
    }
    if (rims) return;
    for (Index a = 0; a < n; ++a) {
      for (Index b = 0; b < n; ++b) {
        if (weights(a, b) > 0.0) items_.push_back({a, a, b, weights(a, b)});
      }
    }
  }

  /// Least over the rotations at x, which it leaves in `rotations`.
  double energy(const Points& x, std::vector<Eigen::Matrix3d>& rotations) const {
    std::vector<Eigen::Matrix3d> s(x.cols(), Eigen::Matrix3d::Zero());
    for (const Item& i : items_) {
      s[i.cell] += i.weight * (x.col(i.a) - x.col(i.b)) * (rest_.col(i.a) - rest_.col(i.b)).transpose();
    }
    rotations.clear();
    for (const Eigen::Matrix3d& m : s) {
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
      Eigen::Matrix3d u = svd.matrixU();
      if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
      rotations.push_back(u * svd.matrixV().transpose());
    }
    double sum = 0.0;
    for (const Item& i : items_) {
      sum += i.weight * (x.col(i.a) - x.col(i.b) - rotations[i.cell] * (rest_.col(i.a) - rest_.col(i.b))).squaredNorm();
    }
    return sum;
  }

  /// From x, whose `held` columns stay. Returns the energy.
  double solve(Points& x, const std::vector<bool>& held, int iterations) const {
    const Index n = static_cast<Index>(x.cols());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    for (const Item& i : items_) {
      k(i.a, i.a) += i.weight;
      k(i.b, i.b) += i.weight;
      k(i.a, i.b) -= i.weight;
      k(i.b, i.a) -= i.weight;
    }
    for (Index p = 0; p < n; ++p) {
      if (!held[p]) continue;
      k.row(p).setZero();
      k(p, p) = 1.0;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(k);
    std::vector<Eigen::Matrix3d> rotations;
    for (int i = 0; i < iterations; ++i) {
      energy(x, rotations);
      Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(n, 3);
      for (const Item& item : items_) {
        const Eigen::RowVector3d d =
            item.weight * (rotations[item.cell] * (rest_.col(item.a) - rest_.col(item.b))).transpose();
        rhs.row(item.a) += d;
        rhs.row(item.b) -= d;
      }
      for (Index p = 0; p < n; ++p) {
        if (held[p]) rhs.row(p) = x.col(p).transpose();
      }
      x = lu.solve(rhs).transpose();
    }
    return energy(x, rotations);
  }

 private:
  Points rest_;
  std::vector<Item> items_;
};

}  // namespace pliant::test
