// Mesh simplification for graph nodes (Sumner 2007, section 3): quadric edge collapse that keeps
// triangles from becoming long and thin, so that what is left is an even layout of nodes.
#pragma once

#include <vector>

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"

namespace pliant {

struct SimplifyOptions {
  Index target_points = 250;  ///< points to keep, at least 1
  /// Longest edge over shortest height: a collapse that makes a triangle thinner, and thinner than
  /// those around it were, waits until all others cost a thousand times as much. At least 2.
  double max_aspect_ratio = 5.0;
};

/// Points of the shape that survive simplification to exactly `target_points`, in canonical order
/// (every survivor is a point of the input: half-edge collapses). A collapse costs the quadric
/// error (Garland and Heckbert 1997) and the squared way of the area it moves, which keeps flat
/// places even; more, if it makes triangles thin, turns them over, changes the topology, or takes a
/// point from a line where other than two triangles meet (a boundary, say). Any mesh is accepted:
/// points without triangles go first, and components too small for a node go entirely. Numbering
/// the points otherwise does not change the result; nor does, on shapes without rotational
/// symmetry, moving, turning or scaling the scene.
/// Errors: invalid_option (target out of range, aspect limit below 2, shape without triangles).
Result<std::vector<Index>> simplify(const Shape& shape, const SimplifyOptions& options);

}  // namespace pliant
