// Directions on a surface: painted, along an axis, along curvature, along shortest paths.
#pragma once

#include "pliant/deformers/edge_material/options.h"

namespace pliant::edge_material {

/// 3 x p: a unit tangent vector at every point of the shape, its sign without meaning, or zero
/// where there is no direction: no stroke in this part of the shape, axis across the surface, equal
/// curvatures, a source. `field` must be valid.
///
/// Strokes are interpolated as harmonic functions of the tensor d d' (which knows no sign) and
/// projected on the tangent planes. Curvature: Cohen-Steiner & Morvan: Restricted Delaunay
/// Triangulations and Normal Cycle, 2003, over two rings. Shortest paths: the gradient of a heat
/// flow (Crane, Weischedel, Wardetzky: Geodesics in Heat, 2013, steps I and II). Errors:
/// not_solvable, too_large.
Result<Points> direction_field(const Shape& shape, const DirectionField& field);

}  // namespace pliant::edge_material
