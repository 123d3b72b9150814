// Rotations nearest to something: to a matrix, or to the motion of a set of points.
#pragma once

#include "pliant/core/types.h"

namespace pliant {

/// The rotation closest to a matrix in the Frobenius norm (polar factor with determinant +1).
Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& matrix);

/// A rotation and its vector: axis times angle in radians, of any size one way, at most pi the
/// other.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& rotation_vector);
Eigen::Vector3d rotation_vector_of(const Eigen::Matrix3d& rotation);

/// The rigid motion that takes points to others best in the least-squares sense (Kabsch), from the
/// pairs added so far. Where they leave the turn open (one point, or all on a line) it is the
/// smallest one; where all of them stay, and without any, exactly the identity.
class RigidFit {
 public:
  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  RigidMotion motion() const;
  /// The means of both sets, which the motion takes to each other; zero without any pair.
  Eigen::Vector3d from_center() const;
  Eigen::Vector3d to_center() const;

 private:
  // Sums over the pairs, relative to the first, so that they keep their digits.
  Eigen::Vector3d first_from_ = Eigen::Vector3d::Zero(), first_to_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero(), to_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero();  ///< to from'
  double from_squared_ = 0.0, to_squared_ = 0.0;
  Index count_ = 0;
  bool all_stay_ = true;
};

}  // namespace pliant
