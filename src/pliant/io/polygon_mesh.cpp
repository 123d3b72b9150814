#include "pliant/io/polygon_mesh.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/message.h"

namespace pliant::io {

void PolygonCollector::Largest::see(std::uint32_t other, std::uint64_t at) {
  if (any && other <= id) {
    return;
  }
  *this = {other, at, true};
}

void PolygonCollector::corner(std::uint32_t vertex, std::uint32_t texcoord, std::uint64_t where) {
  vertex_.see(vertex, where);
  mesh_.face_vertices.push_back(vertex);
  if (texcoord != PolygonMesh::kNoTexcoord) {
    texcoord_.see(texcoord, where);
    if (!textured_) {
      textured_ = true;
      mesh_.corner_texcoords.assign(mesh_.face_vertices.size() - 1, PolygonMesh::kNoTexcoord);
    }
  }
  if (textured_) {
    mesh_.corner_texcoords.push_back(texcoord);
  }
}

void PolygonCollector::end_polygon() {
  const std::uint32_t first = mesh_.face_offsets.back();
  const auto end = static_cast<std::uint32_t>(mesh_.face_vertices.size());
  if (end - first >= 3) {
    mesh_.face_offsets.push_back(end);
  } else {
    mesh_.face_vertices.resize(first);
    if (textured_) {
      mesh_.corner_texcoords.resize(first);
    }
  }
}

void PolygonCollector::texcoord(double u, double v) { mesh_.texcoords.insert(mesh_.texcoords.end(), {u, v}); }

void PolygonCollector::color(std::uint64_t vertex, const double (&rgb)[3]) {
  mesh_.colors.resize(3 * vertex, 255);
  for (const double channel : rgb) {
    // What is no number is black, as a cast of it would be undefined.
    const double inside = channel > 0.0 ? std::min(channel, 1.0) : 0.0;
    mesh_.colors.push_back(static_cast<std::uint8_t>(std::lround(255.0 * inside)));
  }
}

Status PolygonCollector::finish(std::uint64_t vertex_count, const char* unit, int first_id) {
  if (!mesh_.colors.empty()) {
    mesh_.colors.resize(3 * vertex_count, 255);
  }
  const auto check = [&](const Largest& largest, std::uint64_t count, const char* kind, const char* plural) -> Status {
    if (!largest.any || largest.id < count) {
      return {};
    }
    return {ErrorCode::parse_error,
            message({unit, " ", largest.where, ": face refers to ", kind, " ", largest.id + std::uint64_t(first_id),
                     "; the file has ", count, " ", plural, first_id == 0 ? ", counted from 0" : ""})};
  };
  Status vertices = check(vertex_, vertex_count, "vertex", "vertices");
  if (!vertices.ok()) {
    return vertices;
  }
  return check(texcoord_, texcoord_count(), "texture coordinate", "texture coordinates");
}

}  // namespace pliant::io
