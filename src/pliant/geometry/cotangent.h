// Cotangents of triangle corners, safe on bad triangles.
#pragma once

#include <vector>

#include "pliant/core/types.h"
#include "pliant/geometry/adjacency.h"

namespace pliant {

/// A triangle whose height is below this part of its longest edge gets the cotangents it would have
/// at that height.
inline constexpr double kLeastHeight = 1e-6;

/// Half the cotangent of each corner, 3 x m: entry (c, t) belongs to corner c of triangle t and to
/// the edge across it. Finite on every triangle with three distinct points. The three of a triangle
/// are damped by one factor, so that its Dirichlet energy sum_c w_c |edge across c|^2 stays at
/// least 0.
Points half_cotangents(const Points& points, const Triangles& triangles);

/// Sum of the half cotangents across each edge of the same triangles: the weights of the cotangent
/// Laplacian, of any sign.
std::vector<double> cotangent_weights(const Points& half_cotangents, const Triangles& triangles,
                                      const EdgeTable& edges);

}  // namespace pliant
