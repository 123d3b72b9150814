#include "pliant/geometry/closest_rotation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "pliant/linalg/svd3.h"

namespace pliant {

namespace {

/// The smallest rotation that takes one unit vector to another.
Eigen::Matrix3d smallest_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d axis = from.cross(to);
  const double sine = axis.norm(), cosine = from.dot(to);
  const Eigen::Vector3d direction = sine > 0.0 ? Eigen::Vector3d(axis / sine) : from.unitOrthogonal();
  return Eigen::AngleAxisd(std::atan2(sine, cosine), direction).toRotationMatrix();
}

}  // namespace

Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& matrix) {
  const Svd3 svd = svd3(matrix);
  Eigen::Matrix3d u = svd.u;
  if ((u * svd.v.transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
  return u * svd.v.transpose();
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

Eigen::Vector3d rotation_vector_of(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

void RigidFit::add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  all_stay_ = all_stay_ && from == to;
  if (count_++ == 0) {
    first_from_ = from;
    first_to_ = to;
    return;
  }
  const Eigen::Vector3d a = from - first_from_, b = to - first_to_;
  from_ += a;
  to_ += b;
  products_ += b * a.transpose();
  from_squared_ += a.squaredNorm();
  to_squared_ += b.squaredNorm();
}

Eigen::Vector3d RigidFit::from_center() const { return first_from_ + from_ / std::max(count_, 1); }

Eigen::Vector3d RigidFit::to_center() const { return first_to_ + to_ / std::max(count_, 1); }

RigidMotion RigidFit::motion() const {
  RigidMotion motion;
  if (all_stay_) return motion;
  const Eigen::Vector3d from_mean = from_ / count_, to_mean = to_ / count_;
  const Eigen::Matrix3d covariance = products_ - to_ * from_mean.transpose();
  const double from_spread = from_squared_ - from_.dot(from_mean);
  const double to_spread = to_squared_ - to_.dot(to_mean);
  const Svd3 svd = svd3(covariance);
  const Eigen::Vector3d& s = svd.values;

  // Below this share of the spread a singular value is rounding: the points lie on a line, or in
  // one.
  constexpr double kRankTolerance = 1e-10;
  const double spread = std::sqrt(std::max(from_spread * to_spread, 0.0));
  if (s[1] > kRankTolerance * spread) {
    motion.rotation = closest_rotation(covariance);
  } else if (s[0] > kRankTolerance * spread && spread > 0.0) {
    motion.rotation = smallest_turn(svd.v.col(0), svd.u.col(0));
  }
  motion.translation = to_center() - motion.rotation * from_center();
  return motion;
}

}  // namespace pliant
