// XYZ: points, one a line, "x y z" and any further columns (normals, colours), which stay as they
// are: nothing in the file says what they mean. Blank lines and lines that begin with # or // are
// comments.
#pragma once

#include <span>

#include "pliant/io/bytes.h"

namespace pliant::io {

/// positions: 3 n; written with 17 significant digits, appended to `out`.
void write_xyz(std::span<const double> positions, Bytes& out);

}  // namespace pliant::io
