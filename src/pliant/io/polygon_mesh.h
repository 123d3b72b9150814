// What a file holds of a shape: points, polygons over them, texture coordinates at their corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "pliant/core/status.h"

namespace pliant::io {

/// The corners of all polygons stand in one list; polygon f is corners
/// face_offsets[f] .. face_offsets[f + 1], at least three of them.
struct PolygonMesh {
  static constexpr std::uint32_t kNoTexcoord = 0xFFFFFFFF;

  std::vector<double> positions;                ///< 3 n, in the file's unit and order
  std::vector<std::uint32_t> face_vertices;     ///< a vertex id a corner
  std::vector<std::uint32_t> face_offsets{0};   ///< polygons + 1
  std::vector<double> texcoords;                ///< 2 t
  std::vector<std::uint32_t> corner_texcoords;  ///< an id into texcoords, or no_texcoord, a corner;
                                                ///< empty where no polygon has texture coordinates
  std::vector<std::uint8_t> colors;             ///< 3 n, red, green, blue in sRGB; empty where no vertex has any

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t face_count() const { return face_offsets.size() - 1; }
  /// (u, v) of a corner, where corner_texcoords is not empty; (0, 0) where the corner has none.
  std::array<double, 2> corner_texcoord(std::size_t corner) const {
    const std::size_t id = corner_texcoords[corner];
    if (id == kNoTexcoord) {
      return {0.0, 0.0};
    }
    return {texcoords[2 * id], texcoords[2 * id + 1]};
  }
};

/// Collects polygons in the order of a file. Formats let a polygon stand before its vertices, so
/// ids are checked at the end; the place of the largest one is kept for the message.
class PolygonCollector {
 public:
  /// Beyond this the 2 GB of a WASM module's memory run out.
  static constexpr std::size_t kMaxCorners = 48'000'000;
  static constexpr std::size_t kMaxTexturedCorners = 24'000'000;
  static constexpr std::size_t kMaxTexcoords = 16'000'000;

  /// Adds a corner to the polygon under way. `where`: line or byte, for messages.
  void corner(std::uint32_t vertex, std::uint32_t texcoord, std::uint64_t where);
  /// Ends the polygon under way. One of fewer than three corners (OFF and PLY know points and
  /// edges) is left out.
  void end_polygon();
  void texcoord(double u, double v);
  /// The colour of a vertex, each channel from 0 to 1; vertices in ascending order, some may be left out and are white.
  void color(std::uint64_t vertex, const double (&rgb)[3]);

  bool too_large() const {
    return mesh_.face_vertices.size() > kMaxCorners || mesh_.corner_texcoords.size() > kMaxTexturedCorners ||
           mesh_.texcoords.size() > 2 * kMaxTexcoords;
  }
  std::uint32_t texcoord_count() const { return static_cast<std::uint32_t>(mesh_.texcoords.size() / 2); }

  /// Checks every id against the counts. For the message: `unit` of places, "line" or "byte", and
  /// the id the format gives the first vertex. Errors: parse_error.
  Status finish(std::uint64_t vertex_count, const char* unit, int first_id);
  /// The mesh, without positions.
  PolygonMesh take() { return std::move(mesh_); }

 private:
  /// The largest id seen and where it stood.
  struct Largest {
    std::uint32_t id = 0;
    std::uint64_t where = 0;
    bool any = false;
    void see(std::uint32_t other, std::uint64_t at);
  };

  PolygonMesh mesh_;
  Largest vertex_;
  Largest texcoord_;
  bool textured_ = false;
};

}  // namespace pliant::io
