#include "pliant/geometry/closest_rotation.h"

#include <cmath>

#include <Eigen/Geometry>

#include "pliant/linalg/svd3.h"

namespace pliant {

namespace {

/// The smallest rotation that takes one unit vector to another.
Eigen::Matrix3d smallest_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d axis = from.cross(to);
  const double sine = axis.norm(), cosine = from.dot(to);
  const Eigen::Vector3d direction =
      sine > 0.0 ? Eigen::Vector3d(axis / sine) : from.unitOrthogonal();
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

RigidMotion fit_rigid_motion(const Points& from, const Points& to) {
  const Eigen::Vector3d from_center = from.rowwise().mean(), to_center = to.rowwise().mean();
  const Points a = from.colwise() - from_center, b = to.colwise() - to_center;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Index i = 0; i < a.cols(); ++i) covariance += b.col(i) * a.col(i).transpose();
  const Svd3 svd = svd3(covariance);
  const Eigen::Vector3d& s = svd.values;

  RigidMotion motion;
  // Below this share of the spread a singular value is rounding: the points lie on a line, or in
  // one.
  constexpr double kRankTolerance = 1e-10;
  const double spread = a.norm() * b.norm();
  if (s[1] > kRankTolerance * spread) {
    motion.rotation = closest_rotation(covariance);
  } else if (s[0] > kRankTolerance * spread && spread > 0.0) {
    motion.rotation = smallest_turn(svd.v.col(0), svd.u.col(0));
  }
  motion.translation = to_center - motion.rotation * from_center;
  return motion;
}

}  // namespace pliant
