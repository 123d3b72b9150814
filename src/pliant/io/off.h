// OFF, one vertex or face a line, with the prefixes ST, C and N in this order (COFF, NOFF, CNOFF,
// ...). Colours and other columns behind the coordinates stay in a rewritten file; the normals of
// NOFF do not, since they belong to the old shape: the file becomes OFF.
#pragma once

#include <span>

#include "pliant/io/bytes.h"
#include "pliant/io/polygon_mesh.h"

namespace pliant::io {

/// Vertices and polygons as plain OFF, 17 significant digits; texture coordinates are left out.
/// positions: 3 n, in place of the mesh's own. Appends to `out`.
void write_off(const PolygonMesh& mesh, std::span<const double> positions, Bytes& out);

}  // namespace pliant::io
