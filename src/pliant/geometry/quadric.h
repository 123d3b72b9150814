// Quadric errors (Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics",
// 1997).
#pragma once

#include <algorithm>

#include <Eigen/Core>

namespace pliant {

/// The sum of weighted squared distances from planes, as a function of the offset from one point:
/// offset' A offset + 2 b' offset + c. Kept about the point itself, so that rounding is relative to
/// the length of edges and not to the size of the shape.
struct Quadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0.0;

  /// A plane through the point.
  void add_plane(const Eigen::Vector3d& normal, double weight) { a += weight * normal * normal.transpose(); }
  double at(const Eigen::Vector3d& offset) const {
    return std::max(0.0, offset.dot(a * offset) + 2.0 * b.dot(offset) + c);
  }
  /// The same function about the point at `offset`.
  Quadric about(const Eigen::Vector3d& offset) const { return {a, b + a * offset, at(offset)}; }
  void add(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
  }
};

}  // namespace pliant
