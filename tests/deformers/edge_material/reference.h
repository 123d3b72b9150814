// The paper's iteration (eq. 10-12 and 15), dense and plain, from a saved state alone.
#pragma once

#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pliant/solve/deformer.h"

namespace pliant::test {

class EdgeReference {
 public:
  explicit EdgeReference(const State& state) {
    const auto column = [&](const char* name) { return state.find(name)->data; };
    const auto i = column("edges[]/i"), j = column("edges[]/j"), l = column("edges[]/l"), m = column("edges[]/m"),
               alpha = column("edges[]/alpha"), beta = column("edges[]/beta"), rho = column("edges[]/rho"),
               sigma = column("edges[]/sigma"), kappa = column("edges[]/kappa");
    for (std::size_t e = 0; e < i.size(); ++e) {
      const auto id = [](double v) { return static_cast<Index>(v); };
      edges_.push_back({id(i[e]), id(j[e]), id(l[e]), id(m[e]), alpha[e], beta[e], rho[e], sigma[e], kappa[e]});
    }
    lambda_ = column("weights/lambda")[0];
    mu_ = column("weights/mu")[0];
    p_stretch_ = column("weights/pStretch")[0];
    p_bend_ = column("weights/pBend")[0];
  }

  /// lambda p_rho E_rho + mu p_sigma E_sigma.
  double energy(const Points& x) const {
    double sum = 0.0;
    for (const Edge& e : edges_) {
      sum += lambda_ * p_stretch_ * e.kappa * (rho(e, x) - e.rho * rho(e, x).normalized()).squaredNorm();
      if (e.l < 0) continue;
      sum += mu_ * p_bend_ * e.kappa * (sigma(e, x) - e.sigma * normal(e, x)).squaredNorm();
    }
    return sum;
  }

  /// Estimates and measures in turns; `held` columns of x stay.
  void iterate(Points& x, const std::vector<bool>& held, int iterations) const {
    const Index n = static_cast<Index>(x.cols());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    const auto add_squared = [&](const Eigen::VectorXd& row, double weight) { k += weight * row * row.transpose(); };
    for (const Edge& e : edges_) {
      add_squared(rho_row(e, n), lambda_ * e.kappa);
      if (e.l >= 0) add_squared(sigma_row(e, n), mu_ * e.kappa);
    }
    for (Index p = 0; p < n; ++p) {
      if (!held[p]) continue;
      k.row(p).setZero();
      k(p, p) = 1.0;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(k);
    for (int i = 0; i < iterations; ++i) {
      Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(n, 3);
      for (const Edge& e : edges_) {
        const Eigen::Vector3d wanted = (1 - p_stretch_) * rho(e, x) + p_stretch_ * e.rho * rho(e, x).normalized();
        rhs += lambda_ * e.kappa * rho_row(e, n) * wanted.transpose();
        if (e.l < 0) continue;
        const Eigen::Vector3d bent = (1 - p_bend_) * sigma(e, x) + p_bend_ * e.sigma * normal(e, x);
        rhs += mu_ * e.kappa * sigma_row(e, n) * bent.transpose();
      }
      for (Index p = 0; p < n; ++p) {
        if (held[p]) rhs.row(p) = x.col(p).transpose();
      }
      x = lu.solve(rhs).transpose();
    }
  }

 private:
  struct Edge {
    Index i, j, l, m;
    double alpha, beta, rho, sigma, kappa;
  };
  static Eigen::VectorXd rho_row(const Edge& e, Index n) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    row[e.i] = 1.0;
    row[e.j] = -1.0;
    return row;
  }
  static Eigen::VectorXd sigma_row(const Edge& e, Index n) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    row[e.i] = e.alpha;
    row[e.j] = 1 - e.alpha;
    row[e.l] = -e.beta;
    row[e.m] = e.beta - 1;
    return row;
  }
  static Eigen::Vector3d rho(const Edge& e, const Points& x) { return x.col(e.i) - x.col(e.j); }
  static Eigen::Vector3d sigma(const Edge& e, const Points& x) {
    return e.alpha * x.col(e.i) + (1 - e.alpha) * x.col(e.j) - e.beta * x.col(e.l) - (1 - e.beta) * x.col(e.m);
  }
  /// Eq. 4: l lies left of the way from i to j, m right.
  static Eigen::Vector3d normal(const Edge& e, const Points& x) {
    const Eigen::Vector3d left = (x.col(e.j) - x.col(e.i)).cross(Eigen::Vector3d(x.col(e.l) - x.col(e.i)));
    const Eigen::Vector3d right = (x.col(e.i) - x.col(e.j)).cross(Eigen::Vector3d(x.col(e.m) - x.col(e.j)));
    return (left + right).normalized();
  }

  std::vector<Edge> edges_;
  double lambda_, mu_, p_stretch_, p_bend_;
};

}  // namespace pliant::test
