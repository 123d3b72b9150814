// The part of a shape around places on it: what a brush touches.
#pragma once

#include <span>
#include <vector>

#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// A place on a shape: a point of it, and the centre of a ball near that point.
struct Spot {
  Index point;
  Eigen::Vector3d center;
};

/// Knows who touches whom in one shape, to be asked again and again. Keeps a reference to the shape.
class Patches {
 public:
  explicit Patches(const Shape& shape);

  /// The points of a patch, ascending: of each spot its point, and all that can be reached from there along triangles
  /// without leaving the ball of this radius around its centre. Where fewer corners than points are joined by triangles
  /// (points, a polygon soup that shares none) all within the ball count as reached.
  /// positions: 3 x p, where the points are now.
  std::vector<Index> around(const Points& positions, std::span<const Spot> spots, double radius) const;

 private:
  const Shape& shape_;
  Incidence triangles_;  ///< of the points
};

}  // namespace pliant
