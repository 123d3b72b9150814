// Polygons as triangles, for the solvers, which know nothing else.
#pragma once

#include <cstdint>
#include <vector>

#include "pliant/io/polygon_mesh.h"

namespace pliant::io {

/// 3 m vertex ids: a polygon of k corners gives k - 2 triangles in the polygon's orientation,
/// polygons in order. Strictly convex ones become fans from their first corner; others are clipped
/// ear by ear in the plane of their area vector. What has no valid ear left (self-intersecting, no
/// area) still gives its k - 2 triangles. Work is bounded: past some 10^8 tests in all, as no
/// ordinary shape needs, the rest of the concave polygons become fans too.
std::vector<std::uint32_t> triangulate(const PolygonMesh& mesh);

}  // namespace pliant::io
