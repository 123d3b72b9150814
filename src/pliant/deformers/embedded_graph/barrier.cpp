#include "pliant/deformers/embedded_graph/barrier.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pliant/deformers/embedded_graph/pose.h"

namespace pliant::embedded::barrier {
namespace {

/// A step must lower the sum by this part of what its slope promises (Armijo).
constexpr double kSufficient = 1e-4;
/// Near the barrier a node keeps this part of its determinant in a step: next to 0 the curvature
/// of the barrier would drown all else.
constexpr double kLeastKept = 0.2;
/// Beside more than this a matrix loses the rest to rounding.
constexpr double kMostCurvature = 1e10;
/// The length of a step is found to this part of it where determinants matter.
constexpr double kStepAccuracy = 1e-3;

Eigen::Matrix3d affine_part(const GraphEnergy& energy, const Vector& x, Index j) {
  return Eigen::Matrix3d::Identity() + energy.displacement_gradient(x, j);
}

/// F + w sum b along a line.
struct Both {
  const Quartic& course;
  const std::vector<DeterminantAlong>& along;
  double weight;

  double sum(double alpha) const {
    double sum = 0.0;
    for (const DeterminantAlong& node : along) sum += value(node.at(alpha));
    return sum;
  }
  double at(double alpha) const { return course.value(alpha) + weight * sum(alpha); }
  /// Infinite where a node has lost too much of its determinant.
  double slope_at(double alpha) const {
    double sum = 0.0;
    for (const DeterminantAlong& node : along) {
      const double determinant = node.at(alpha);
      if (determinant < kLeastKept * std::min(kSafeDeterminant, node.at_start())) {
        return std::numeric_limits<double>::infinity();
      }
      if (determinant < kSafeDeterminant) sum += slope(determinant) * node.slope_at(alpha);
    }
    return course.slope(alpha) + weight * sum;
  }
};

}  // namespace

double value(double determinant) {
  const double s = determinant / kSafeDeterminant;
  if (s >= 1.0) return 0.0;
  if (!(s > 0.0)) return std::numeric_limits<double>::infinity();
  return -(1.0 - s) * (1.0 - s) * std::log(s);
}

double slope(double determinant) {
  const double s = determinant / kSafeDeterminant;
  if (s >= 1.0) return 0.0;
  return (2.0 * (1.0 - s) * std::log(s) - (1.0 - s) * (1.0 - s) / s) / kSafeDeterminant;
}

double curvature(double determinant) {
  const double s = determinant / kSafeDeterminant;
  if (s >= 1.0) return 0.0;
  const double q = (1.0 - s) / s;
  return (-2.0 * std::log(s) + 4.0 * q + q * q) / (kSafeDeterminant * kSafeDeterminant);
}

DeterminantAlong::DeterminantAlong(const Eigen::Matrix3d& r, const Eigen::Matrix3d& d) {
  auto mixed = [](const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return a.col(0).dot(b.col(1).cross(b.col(2))) + b.col(0).dot(a.col(1).cross(b.col(2))) +
           b.col(0).dot(b.col(1).cross(a.col(2)));
  };
  c_ = {r.determinant(), mixed(d, r), mixed(r, d), d.determinant()};
}

double sum(const GraphEnergy& energy, const Vector& x) {
  double sum = 0.0;
  for (Index j = 0; j < energy.free_nodes(); ++j) sum += value(affine_part(energy, x, j).determinant());
  return sum;
}

void add_half_gradient(const GraphEnergy& energy, const Vector& x, Vector& gradient) {
  for (Index j = 0; j < energy.free_nodes(); ++j) {
    const Eigen::Matrix3d r = affine_part(energy, x, j);
    const double slope_of_node = slope(r.determinant());
    if (slope_of_node == 0.0) continue;
    const Eigen::Matrix3d g = 0.5 * energy.weights().rotation * slope_of_node * cofactors(r);
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) energy.entry(gradient, a, j)[c] += g(a, c);
    }
  }
}

void add_half_curvature(const GraphEnergy& energy, const Vector& x, BlockMatrix& matrix) {
  using Gradient = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  for (Index j = 0; j < energy.free_nodes(); ++j) {
    const Eigen::Matrix3d r = affine_part(energy, x, j);
    const double curvature_of_node = std::min(curvature(r.determinant()), kMostCurvature);
    if (curvature_of_node == 0.0) continue;
    Gradient g = Gradient::Zero();
    g.leftCols<3>() = cofactors(r);
    const Eigen::Map<const Eigen::Matrix<double, 12, 1>> gradient(g.data());
    Eigen::Map<Eigen::Matrix<double, 12, 12>>(matrix.diagonal_block(j)) +=
        0.5 * energy.weights().rotation * curvature_of_node * gradient * gradient.transpose();
  }
}

Fall first_minimum(const GraphEnergy& energy, const Quartic& course, double slope, const Vector& x, const Vector& d,
                   std::vector<DeterminantAlong>& along) {
  along.clear();
  for (Index j = 0; j < energy.free_nodes(); ++j) {
    along.emplace_back(affine_part(energy, x, j), energy.displacement_gradient(d, j));
  }
  const double smooth = course.first_minimum();
  const bool safe = std::all_of(along.begin(), along.end(), [&](const DeterminantAlong& node) {
    return node.at_start() >= kSafeDeterminant && node.at(smooth) >= kSafeDeterminant;
  });
  if (safe) return {smooth, 0.0};

  // A bracket of the first minimum, halved: low is where both still fall.
  const Both both{course, along, energy.weights().rotation};
  double low = 0.0, high = smooth > 0.0 ? smooth : 1.0;
  while (high < 1e3 && both.slope_at(high) < 0.0) {
    low = high;
    high *= 2.0;
  }
  while (high > 1e-12 && high - low > kStepAccuracy * high) {
    const double middle = 0.5 * (low + high);
    (both.slope_at(middle) < 0.0 ? low : high) = middle;
  }
  const double start = both.at(0.0);
  for (double alpha = low; alpha > 1e-12; alpha *= 0.5) {
    const double there = both.at(alpha);
    if (there < start && there <= start + kSufficient * alpha * slope) return {alpha, both.sum(alpha)};
  }
  return {0.0, both.sum(0.0)};
}

}  // namespace pliant::embedded::barrier
