// The header of a PLY file. Internal to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/status.h"

namespace pliant::io {

enum class PlyEncoding { ascii, binary_little, binary_big };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// What Pliant does with a property.
enum class PlyRole {
  keep,              ///< passes through
  drop,              ///< left out of a rewritten file
  x,                 ///< coordinates
  y,                 ///
  z,                 ///
  nx,                ///< normal of the vertex
  ny,                ///
  nz,                ///
  u,                 ///< texture coordinates of the vertex
  v,                 ///
  red,               ///< colour of the vertex: whole numbers up to the largest of their type, or fractions
  green,             ///
  blue,              ///
  corners,           ///< the vertex ids of a polygon
  corner_texcoords,  ///< two numbers a corner of the polygon
  strips             ///< triangle strips, one behind the other with -1 between
};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  PlyRole role = PlyRole::keep;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of lists
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  /// The header of the rewritten file: x, y and z are double, properties to drop are gone.
  std::string rewritten;
  std::uint64_t lines = 0;
};

std::size_t ply_size(PlyType type);

/// The bytes of the header up to and including the line end_header; 0 when `text` does not hold all
/// of it.
std::size_t ply_header_size(std::string_view text);

/// `text`: the whole header. `normals`: those of vertices have a role, where all of nx, ny and nz are floating-point
/// numbers; otherwise they are dropped. Errors: parse_error with the line.
Result<PlyHeader> parse_ply_header(std::string_view text, bool normals);

}  // namespace pliant::io
