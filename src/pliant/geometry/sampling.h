// Points spread evenly over a shape: the nodes of a deformation graph (Sumner 2007, section 3).
#pragma once

#include <cstdint>
#include <vector>

#include "pliant/core/types.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// An order of the points of a shape that does not depend on how they are numbered, nor (where the
/// shape has no symmetry) on how the scene is moved, turned by right angles or scaled: by distance
/// from the centroid, ties (within 1e-9 of the size) by the coordinates along the principal axes.
/// Returns a permutation: order[rank] = point.
std::vector<Index> canonical_order(const Shape& shape);

/// Exactly `count` points on the surface (or among the points, where there are no triangles), by
/// random removal within a radius (Sumner 2007, section 3): dense samples are laid over the
/// surface, and all within a radius of a randomly chosen one are removed until `count` are left.
/// 1 <= count <= points of the shape. Deterministic for a seed; follows `canonical_order`.
/// Returns 3 x count.
Points sample_surface(const Shape& shape, Index count, std::uint64_t seed);

}  // namespace pliant
