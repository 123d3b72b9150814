#include "pliant/geometry/closest_rotation.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace pliant {

Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

RigidMotion fit_rigid_motion(const Points& from, const Points& to) {
  const Eigen::Vector3d from_center = from.rowwise().mean(), to_center = to.rowwise().mean();
  const Points a = from.colwise() - from_center, b = to.colwise() - to_center;
  const Eigen::Matrix3d covariance = b * a.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& s = svd.singularValues();

  RigidMotion motion;
  // Below this share of the spread a singular value is rounding: the points lie on a line, or in
  // one.
  constexpr double kRankTolerance = 1e-10;
  const double spread = a.norm() * b.norm();
  if (s[1] > kRankTolerance * spread) {
    motion.rotation = closest_rotation(covariance);
  } else if (s[0] > kRankTolerance * spread && spread > 0.0) {
    motion.rotation = Eigen::Quaterniond::FromTwoVectors(svd.matrixV().col(0), svd.matrixU().col(0))
                          .toRotationMatrix();
  }
  motion.translation = to_center - motion.rotation * from_center;
  return motion;
}

}  // namespace pliant
