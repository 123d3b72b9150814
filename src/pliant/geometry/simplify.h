// Mesh simplification for graph nodes (Sumner 2007, section 3): quadric edge collapse that keeps
// triangles from becoming long and thin, so that what is left is an even layout of nodes.
#pragma once

#include <vector>

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"

namespace pliant {

struct SimplifyOptions {
  Index target_points = 250;  ///< points to keep, at least 4
  double max_aspect_ratio =
      5.0;  ///< longest edge over shortest height; a collapse may not exceed it
};

/// Points of the shape that survive simplification to exactly `target_points`, ascending ids
/// (every survivor is a point of the input: half-edge collapses). Several components, boundaries
/// and non-manifold edges are accepted; the aspect limit is relaxed step by step where it would
/// stop before the target. Errors: invalid_option (target out of range, shape without triangles).
Result<std::vector<Index>> simplify(const Shape& shape, const SimplifyOptions& options);

}  // namespace pliant
