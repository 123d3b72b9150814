// STL, text and binary: a soup of facets, each with its own three vertices (the checked door welds
// them). In a rewritten file facet normals are computed from the new corners; names, headers and
// attribute bytes stay. Binary STL has 32-bit coordinates, to which new ones are rounded.
#pragma once

#include <cstdint>
#include <span>

#include "pliant/core/status.h"
#include "pliant/io/bytes.h"

namespace pliant::io {

/// Binary STL, appended to `out`. positions: 3 n. triangles: 3 m vertex ids. Errors: invalid_shape
/// (no triangles, a coordinate beyond 32 bits).
Status write_stl(std::span<const double> positions, std::span<const std::uint32_t> triangles, Bytes& out);

}  // namespace pliant::io
