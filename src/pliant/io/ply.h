// PLY: ascii, binary little and big endian. Polygons are read from element face (or, as triangle
// strips, from element tristrips), texture coordinates from its list texcoord or from the vertices'
// u and v, s and t, texture_u and texture_v.
//
// A rewritten file keeps every byte except
//  - the vertices' x, y and z, whose type becomes double in the header and the body,
//  - the vertices' nx, ny and nz, which are left out: they belong to the old shape, and a file
//    without them is read with fresh normals, while one with stale normals is shown with wrong
//    light. Where the draft asks for them they stay, with new numbers of the same type; one that
//    is no finite number becomes zero.
#pragma once

#include <span>

#include "pliant/io/bytes.h"
#include "pliant/io/polygon_mesh.h"

namespace pliant::io {

/// Binary little-endian PLY with double coordinates, polygons and, where the mesh has them, texture
/// coordinates of the corners (0 0 where a corner has none).
/// positions: 3 n, in place of the mesh's own. Appends to `out`.
void write_ply(const PolygonMesh& mesh, std::span<const double> positions, Bytes& out);

}  // namespace pliant::io
