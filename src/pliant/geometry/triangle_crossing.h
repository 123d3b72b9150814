// Whether two triangles in space run through each other.
#pragma once

#include <Eigen/Core>

namespace pliant {

/// True when the triangles (corners in the columns) share more than a contact: they cross along a
/// segment longer than `tolerance`, each with corners farther than that on both sides of the
/// other's plane; or they lie in one plane and overlap by more than that in every direction.
/// Triangles no higher than `tolerance` cross nothing. After Moeller, "A Fast Triangle-Triangle
/// Intersection Test" (1997), with contacts left out: they appear and vanish by rounding.
bool triangles_cross(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double tolerance);

}  // namespace pliant
