// The value types every layer shares.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace pliant {

/// Index of a vertex, point, node or triangle. 32 bits: WASM memory holds no shape that needs more.
using Index = std::int32_t;

/// Points or vectors, one a column: 3 x n, in the input's unit of length. Planar shapes have z = 0.
using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Triangles, one a column: 3 x m vertex indices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<Index, 3, Eigen::Dynamic>;

/// x -> rotation * x + translation.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

}  // namespace pliant
