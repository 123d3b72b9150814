#include "pliant/deformers/rigid_cells/frame.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Geometry>

#include "pliant/linalg/svd3.h"

namespace pliant::cells {
namespace {

/// Variances closer than this, of the larger one, leave the axes between them to the fourth moments.
constexpr double kLeastGap = 0.02;
/// Below this share of the sum of r^4 a section is round: nothing in it tells directions apart.
constexpr double kRound = 1e-3;
/// Third moments below this, of the sum of |x|^3, are rounding.
constexpr double kAlike = 1e-7;
/// The grid is a little larger than the shape, so that nothing lies on its border by rounding.
constexpr double kPadding = 1e-6;

/// Turns the axes u and v about the third so that a square section has its sides along them: the
/// fourth moment sum (x + i y)^4 is then negative.
void align_with_sides(const Points& centered, Eigen::Vector3d& u, Eigen::Vector3d& v) {
  std::complex<double> moment = 0.0;
  double size = 0.0;
  for (const auto& p : centered.colwise()) {
    const std::complex<double> z(p.dot(u), p.dot(v));
    moment += z * z * z * z;
    size += std::norm(z) * std::norm(z);
  }
  if (std::abs(moment) <= kRound * size) return;
  const double angle = (std::arg(moment) + std::numbers::pi) / 4.0;
  const Eigen::Vector3d turned = std::cos(angle) * u + std::sin(angle) * v;
  v = std::cos(angle) * v - std::sin(angle) * u;
  u = turned;
}

/// Of the two directions of an axis, the one in which the shape reaches farther (its third moment is
/// positive); of a shape that is alike both ways, the one nearer to the input's axes.
Eigen::Vector3d with_sign(const Points& centered, const Eigen::Vector3d& axis) {
  const Eigen::ArrayXd along = (axis.transpose() * centered).transpose().array();
  const double third = along.cube().sum(), size = along.abs().cube().sum();
  double sign = third;
  if (std::abs(third) <= kAlike * size) {
    Index most = 0;
    axis.cwiseAbs().maxCoeff(&most);
    sign = axis[most];
  }
  return sign < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

/// The input's axes as far as a direction leaves them free: u and v perpendicular to it.
void input_axes_around(const Eigen::Vector3d& direction, Eigen::Vector3d& u, Eigen::Vector3d& v) {
  int most = 0, least = 0;
  direction.cwiseAbs().maxCoeff(&most);
  direction.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d along = Eigen::Vector3d::Unit(least == most ? (most + 1) % 3 : least);
  u = (along - along.dot(direction) * direction).normalized();
  v = direction.cross(u);
}

Eigen::Matrix3d axes_in_space(const Points& centered) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : centered.colwise()) covariance += p * p.transpose();
  const Svd3 eigen = svd3(covariance);
  const Eigen::Vector3d& variance = eigen.values;
  Eigen::Matrix3d axes = eigen.u;  // columns
  const bool first_two = variance[0] - variance[1] <= kLeastGap * variance[0];
  const bool last_two = variance[1] - variance[2] <= kLeastGap * variance[1];
  if (first_two && last_two) return Eigen::Matrix3d::Identity();
  if (first_two || last_two) {
    const Eigen::Vector3d lone = axes.col(first_two ? 2 : 0);
    Eigen::Vector3d u, v;
    input_axes_around(lone, u, v);
    align_with_sides(centered, u, v);
    axes << lone, u, v;
  }
  axes.col(0) = with_sign(centered, axes.col(0));
  axes.col(1) = with_sign(centered, axes.col(1));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes.transpose();
}

Eigen::Matrix3d axes_in_plane(const Points& centered) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const auto& p : centered.colwise()) covariance += p.head<2>() * p.head<2>().transpose();
  const double difference = covariance(0, 0) - covariance(1, 1), mixed = 2.0 * covariance(0, 1);
  Eigen::Vector3d u = Eigen::Vector3d::UnitX(), v = Eigen::Vector3d::UnitY();
  if (std::hypot(difference, mixed) > kLeastGap * covariance.trace() / 2.0) {
    const double angle = std::atan2(mixed, difference) / 2.0;
    u << std::cos(angle), std::sin(angle), 0.0;
    v << -std::sin(angle), std::cos(angle), 0.0;
  } else {
    align_with_sides(centered, u, v);
  }
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.row(0) = with_sign(centered, u);
  axes.row(1) = Eigen::Vector3d::UnitZ().cross(Eigen::Vector3d(axes.row(0)));
  return axes;
}

}  // namespace

GridFrame grid_frame(const Shape& shape, int resolution, int depth, bool align) {
  GridFrame frame;
  frame.dimension = shape.dimension();
  frame.depth = depth;
  const Eigen::Vector3d mean = shape.points().rowwise().mean();
  const Points centered = shape.points().colwise() - mean;
  if (align) frame.axes = frame.dimension == 2 ? axes_in_plane(centered) : axes_in_space(centered);
  const Points along = frame.axes * centered;
  const Eigen::Vector3d low = along.rowwise().minCoeff(), high = along.rowwise().maxCoeff();
  const double side = (high - low).maxCoeff();
  const double coarse = side > 0.0 ? side * (1.0 + kPadding) / resolution : 1.0;
  const double units = static_cast<double>(1 << depth);
  frame.unit = coarse / units;
  for (int axis = 0; axis < 3; ++axis) {
    frame.counts[axis] = std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / coarse)));
  }
  frame.middle = frame.counts.cast<double>() * units / 2.0;
  if (frame.dimension == 2) frame.middle.z() = 0.0;
  frame.center = mean + frame.axes.transpose() * ((low + high) / 2.0);
  return frame;
}

}  // namespace pliant::cells
