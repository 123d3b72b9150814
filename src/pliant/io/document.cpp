#include "pliant/io/document.h"

#include <cstdlib>
#include <string>

#include "pliant/geometry/shape.h"
#include "pliant/io/check.h"
#include "pliant/io/draft.h"
#include "pliant/io/message.h"
#include "pliant/io/obj.h"
#include "pliant/io/off.h"
#include "pliant/io/ply.h"
#include "pliant/io/scanner.h"
#include "pliant/io/stl.h"
#include "pliant/io/triangulate.h"
#include "pliant/io/xyz.h"

namespace pliant::io {
namespace {

constexpr std::size_t piece_size = 1 << 20;
constexpr std::size_t max_vertices = Shape::max_vertices;
constexpr std::size_t longest_number = 24;  // -1.2345678901234567e-308

Status invalid(Pieces reason) { return {ErrorCode::invalid_shape, message(reason)}; }

Status too_large(Pieces reason) { return {ErrorCode::too_large, message(reason)}; }

/// Without exceptions a vector that cannot grow ends the program, so the memory for the output of a
/// large file is asked for first.
Status reserve(Bytes& out, std::uint64_t size) {
  void* memory = size < SIZE_MAX / 2 ? std::malloc(static_cast<std::size_t>(size)) : nullptr;
  if (!memory) {
    return too_large({"the new file needs up to ", size, " bytes; that much memory is not left"});
  }
  std::free(memory);
  out.reserve(static_cast<std::size_t>(size));
  return {};
}

/// No writer needs more bytes than this.
std::uint64_t size_bound(const PolygonMesh& mesh) {
  constexpr std::uint64_t header = 512;
  constexpr std::uint64_t number = longest_number + 3;  // with a blank and a share of the keyword
  constexpr std::uint64_t corner = 25;                  // two ids, or an id and two doubles
  constexpr std::uint64_t triangle = 50;                // of binary STL; at most one a corner
  return header + number * (mesh.positions.size() + mesh.texcoords.size()) +
         (corner + triangle) * mesh.face_vertices.size();
}

Status check_positions(std::span<const double> positions) {
  if (positions.empty() || positions.size() % 3 != 0) {
    return invalid({"positions has ", positions.size(),
                    " numbers; expected 3 a vertex and at least one vertex"});
  }
  if (positions.size() / 3 > max_vertices) {
    return too_large(
        {"the shape has ", positions.size() / 3, " vertices; expected at most ", max_vertices});
  }
  return check_finite(positions, "positions");
}

/// Reads polygons as (count, ids...) into the mesh.
Status take_polygons(std::span<const std::int32_t> polygons, PolygonMesh& mesh) {
  if (polygons.size() > PolygonCollector::max_corners) {
    return too_large({"polygons has ", polygons.size(), " numbers; expected at most ",
                      PolygonCollector::max_corners});
  }
  for (std::size_t at = 0; at < polygons.size();) {
    const std::int32_t corners = polygons[at++];
    const std::string name = message({"polygon ", mesh.face_count()});
    if (corners < 3 || static_cast<std::size_t>(corners) > polygons.size() - at) {
      return invalid({name, " has a count of ", corners,
                      "; expected at least 3 corners, all of them in the list"});
    }
    for (const std::int32_t id : polygons.subspan(at, static_cast<std::size_t>(corners))) {
      if (id < 0 || static_cast<std::size_t>(id) >= mesh.vertex_count()) {
        return invalid({name, " refers to vertex ", id, "; the shape has ", mesh.vertex_count(),
                        " vertices, counted from 0"});
      }
      mesh.face_vertices.push_back(static_cast<std::uint32_t>(id));
    }
    at += static_cast<std::size_t>(corners);
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.face_vertices.size()));
  }
  return {};
}

}  // namespace

Status Document::read(FileFormat format, Bytes bytes) {
  if (bytes.size() > max_bytes) {
    return too_large(
        {"the file has ", bytes.size(), " bytes; at most ", max_bytes, " can be read whole"});
  }
  PolygonCollector polygons;
  const std::unique_ptr<Scanner> scanner = make_scanner(format, &polygons);
  const std::string_view text = text_of(bytes);
  std::vector<double> positions;
  Draft draft(piece_size);
  for (std::size_t at = 0; at < text.size();) {
    draft.clear();
    const Result<std::size_t> taken = scanner->scan(text.substr(at), true, draft);
    if (!taken.ok()) return taken.status();
    at += *taken;
    positions.insert(positions.end(), draft.points().begin(), draft.points().end());
    if (positions.size() / 3 > max_vertices || polygons.too_large()) {
      return too_large({scanner->place(), ": more than ", max_vertices, " vertices, ",
                        PolygonCollector::max_corners, " corners of faces or ",
                        PolygonCollector::max_texcoords, " texture coordinates"});
    }
  }
  const Status status = scanner->finish();
  if (!status.ok()) return status;
  mesh_ = polygons.take();
  mesh_.positions = std::move(positions);
  triangles_ = triangulate(mesh_);
  source_ = std::move(bytes);
  format_ = format;
  return {};
}

Status Document::assign(std::span<const double> positions, std::span<const std::int32_t> polygons) {
  const Status checked = check_positions(positions);
  if (!checked.ok()) return checked;
  PolygonMesh mesh;
  mesh.positions.assign(positions.begin(), positions.end());
  const Status taken = take_polygons(polygons, mesh);
  if (!taken.ok()) return taken;
  mesh_ = std::move(mesh);
  triangles_ = triangulate(mesh_);
  source_ = Bytes();
  return {};
}

Status Document::assign_texcoords(std::span<const double> texcoords) {
  const std::size_t corners = mesh_.face_vertices.size();
  if (texcoords.size() != 2 * corners) {
    return invalid({"texture coordinates has ", texcoords.size(),
                    " numbers; expected 2 for each of ", corners, " corners"});
  }
  const Status finite = check_finite(texcoords, "texture coordinates");
  if (!finite.ok()) return finite;
  mesh_.texcoords.assign(texcoords.begin(), texcoords.end());
  mesh_.corner_texcoords.resize(corners);
  for (std::size_t c = 0; c < corners; ++c) {
    mesh_.corner_texcoords[c] = static_cast<std::uint32_t>(c);
  }
  return {};
}

Result<Bytes> Document::write(FileFormat format, std::span<const double> positions) const {
  if (mesh_.positions.empty()) return invalid({"the document is empty; read or assign one first"});
  const Status checked = check_positions(positions);
  if (!checked.ok()) return checked;
  if (positions.size() != mesh_.positions.size()) {
    return invalid({"positions has ", positions.size() / 3, " vertices; the document has ",
                    mesh_.vertex_count()});
  }
  if (format == format_ && !source_.empty()) return rewrite(positions);
  return convert(format, positions);
}

/// The Rewriter's way, over bytes that are all here: the scanner stops where the draft is full.
Result<Bytes> Document::rewrite(std::span<const double> positions) const {
  Bytes out;
  const Status reserved =
      reserve(out, std::uint64_t{source_.size()} + longest_number * positions.size());
  if (!reserved.ok()) return reserved;
  const std::unique_ptr<Scanner> scanner = make_scanner(format_, nullptr);
  const std::string_view text = text_of(source_);
  Draft draft(piece_size);
  std::size_t done = 0;
  for (std::size_t at = 0; at < text.size();) {
    draft.clear();
    const Result<std::size_t> taken = scanner->scan(text.substr(at), true, draft);
    if (!taken.ok()) return taken.status();
    at += *taken;
    const std::size_t found = draft.points().size();
    const Status status = draft.emit(positions.subspan(done, found), out);
    if (!status.ok()) return status;
    done += found;
  }
  return out;
}

Result<Bytes> Document::convert(FileFormat format, std::span<const double> positions) const {
  Bytes out;
  const Status reserved = reserve(out, size_bound(mesh_));
  if (!reserved.ok()) return reserved;
  Status status;
  switch (format) {
    case FileFormat::obj:
      write_obj(mesh_, positions, out);
      break;
    case FileFormat::ply:
      write_ply(mesh_, positions, out);
      break;
    case FileFormat::off:
      write_off(mesh_, positions, out);
      break;
    case FileFormat::stl:
      status = write_stl(positions, triangles_, out);
      break;
    case FileFormat::xyz:
      write_xyz(positions, out);
      break;
  }
  if (!status.ok()) return status;
  return out;
}

}  // namespace pliant::io
