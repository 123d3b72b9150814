// Points spread evenly over a shape: the nodes of a deformation graph (Sumner 2007, section 3).
#pragma once

#include <cstdint>

#include "pliant/core/types.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// Exactly `count` points on the surface (or among the points, where there are no triangles with
/// area), by random removal within a radius (Sumner 2007, section 3): dense samples are laid over
/// the surface in proportion to area, whatever the size of the triangles, and all within a radius
/// of a randomly chosen one are removed. The radius is the largest of a fine ladder that leaves
/// enough; the few too many go, one of the closest pair at a time. A component whose share of the
/// area is worth a whole node gets one. 1 <= count <= points of the shape. Deterministic for a
/// seed. All choices hang on `canonical_order`: numbering the points otherwise changes the result
/// by rounding only; so do, on shapes without rotational symmetry, moving, turning and scaling the
/// scene. Returns 3 x count.
Points sample_surface(const Shape& shape, Index count, std::uint64_t seed);

}  // namespace pliant
