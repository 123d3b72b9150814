// Wavefront OBJ. Faces are read by tinyobjloader. Coordinates and texture coordinates are not: its
// number reader adds up rounded digits and is off by several units in the last place, and takes
// what it cannot read for zero, while Pliant promises the nearest double and an error with the
// line.
//
// A rewritten file keeps every byte except
//  - the coordinates of `v` lines (colours or a weight behind them stay),
//  - `vn` lines and the normals in `f` lines (a/b/c becomes a/b, a//c becomes a): normals belong to
//    the old shape, and a file without them is read with fresh ones, while one with stale normals
//    is shown with wrong light.
#pragma once

#include <span>

#include "pliant/io/bytes.h"
#include "pliant/io/polygon_mesh.h"

namespace pliant::io {

/// Vertices, texture coordinates and polygons, 17 significant digits.
/// positions: 3 n, in place of the mesh's own. Appends to `out`.
void write_obj(const PolygonMesh& mesh, std::span<const double> positions, Bytes& out);

}  // namespace pliant::io
