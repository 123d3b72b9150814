#include "pliant/geometry/canonical_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pliant/core/sort.h"
#include "pliant/linalg/svd3.h"

namespace pliant {
namespace {

constexpr double kTie = 1e-9;            // of the root mean square distance from the centroid
constexpr double kLeastGap = 1e-5;       // between variances, of the largest one
constexpr double kLeastSkewness = 1e-9;  // of a third moment, in units of the largest variance^1.5

/// Rows: directions that move with the shape where it has such, else the input's axes.
Eigen::Matrix3d intrinsic_frame(const Points& centered) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : centered.colwise()) covariance += p * p.transpose();
  covariance /= static_cast<double>(centered.cols());
  const Svd3 eigen = svd3(covariance);
  const Eigen::Vector3d& variance = eigen.values;
  if (std::min(variance[0] - variance[1], variance[1] - variance[2]) <= kLeastGap * variance[0]) {
    return Eigen::Matrix3d::Identity();
  }
  Eigen::Matrix3d axes = eigen.u.transpose();
  int signless = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double third_moment = (axes.row(axis) * centered).array().cube().mean() / std::pow(variance[0], 1.5);
    if (std::abs(third_moment) > kLeastSkewness) {
      axes.row(axis) *= third_moment > 0 ? 1 : -1;
    } else if (signless < 0) {
      signless = axis;
    } else {
      return Eigen::Matrix3d::Identity();  // a half turn may be a symmetry
    }
  }
  // A mirror plane leaves one sign open; turning the scene keeps the frame right-handed.
  if (signless >= 0 && axes.determinant() < 0) {
    axes.row(signless) *= -1;
  }
  return axes;
}

class Sorter {
 public:
  explicit Sorter(const Shape& shape) : points_(shape.points()) {
    const Eigen::Vector3d centroid = points_.rowwise().mean();
    centered_ = points_.colwise() - centroid;
    frame_ = intrinsic_frame(centered_);
    tolerance_ = kTie * std::sqrt(centered_.colwise().squaredNorm().mean());
  }

  std::vector<Index> sorted() {
    std::vector<Index> order(points_.cols());
    std::iota(order.begin(), order.end(), Index{0});
    sort(order, 0);
    return order;
  }

 private:
  static constexpr int kInput = 4;   // levels before it: the distance, then three coordinates in the frame
  static constexpr int kLevels = 7;  // the last three: the input's own coordinates, which no two points share

  double measure(Index p, int level) const {
    if (level >= kInput) return points_(level - kInput, p);
    return level == 0 ? centered_.col(p).norm() : frame_.row(level - 1).dot(centered_.col(p));
  }

  /// Sorts by the measure of `level`, and runs that follow each other within the tolerance (among the input's own
  /// coordinates: that are the same) by the next one.
  void sort(std::span<Index> range, int level) {
    const double tolerance = level < kInput ? tolerance_ : 0.0;
    std::vector<Keyed> items;
    items.reserve(range.size());
    for (const Index p : range) items.push_back({key_of(measure(p, level)), p});
    sort_keyed(items);
    for (std::size_t i = 0; i < range.size(); ++i) range[i] = items[i].index;
    for (std::size_t begin = 0; begin < range.size();) {
      std::size_t end = begin + 1;
      while (end < range.size() && measure(range[end], level) - measure(range[end - 1], level) <= tolerance) {
        ++end;
      }
      if (end - begin > 1 && level + 1 < kLevels) {
        sort(range.subspan(begin, end - begin), level + 1);
      }
      begin = end;
    }
  }

  const Points& points_;
  Points centered_;
  Eigen::Matrix3d frame_;
  double tolerance_;
};

}  // namespace

std::vector<Index> canonical_order(const Shape& shape) { return Sorter(shape).sorted(); }

Triangles canonical_triangles(const Shape& shape, const std::vector<Index>& order) {
  std::vector<Index> rank(order.size());
  for (Index r = 0; r < static_cast<Index>(order.size()); ++r) {
    rank[order[r]] = r;
  }
  std::vector<std::array<Index, 3>> sorted(shape.triangles().cols());
  for (Index t = 0; t < shape.triangles().cols(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      sorted[t][corner] = rank[shape.triangles()(corner, t)];
    }
    std::sort(sorted[t].begin(), sorted[t].end());
  }
  Triangles triangles(3, shape.triangles().cols());
  const auto count = static_cast<Index>(triangles.cols());
  // By the latter two corners, then by the first: equal ones stay as they are.
  const std::vector<Index> by_latter = order_by(count, [&](Index t) { return key_of(sorted[t][1], sorted[t][2]); });
  const std::vector<Index> by_first = order_by(count, [&](Index i) { return key_of(0, sorted[by_latter[i]][0]); });
  for (Index t = 0; t < count; ++t) {
    const auto& [a, b, c] = sorted[by_latter[by_first[t]]];
    triangles.col(t) << a, b, c;
  }
  return triangles;
}

}  // namespace pliant
