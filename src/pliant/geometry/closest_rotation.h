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

/// The rigid motion that takes `from` to `to` (3 x n each) best in the least-squares sense
/// (Kabsch). Where the points leave the turn open (one point, or all on a line) it is the smallest
/// one.
RigidMotion fit_rigid_motion(const Points& from, const Points& to);

}  // namespace pliant
