#include "pliant/io/document.h"

#include <string>

#include "pliant/core/message.h"
#include "pliant/geometry/shape.h"
#include "pliant/io/check.h"
#include "pliant/io/draft.h"
#include "pliant/io/memory.h"
#include "pliant/io/obj.h"
#include "pliant/io/off.h"
#include "pliant/io/ply.h"
#include "pliant/io/scanner.h"
#include "pliant/io/stl.h"
#include "pliant/io/triangulate.h"
#include "pliant/io/xyz.h"

namespace pliant::io {
namespace {

constexpr std::size_t kMaxVertices = Shape::kMaxVertices;

Status invalid(Words reason) { return {ErrorCode::invalid_shape, message(reason)}; }

Status too_large(Words reason) { return {ErrorCode::too_large, message(reason)}; }

Status reserve(Bytes& out, std::uint64_t size) {
  if (!memory_suffices(size)) {
    return too_large({"the new file needs up to ", size, " bytes; that much memory is not left"});
  }
  out.reserve(static_cast<std::size_t>(size));
  return {};
}

/// The writer of the format needs no more bytes than this.
std::uint64_t size_bound(FileFormat format, const PolygonMesh& mesh, std::size_t triangle_ids) {
  constexpr std::uint64_t header = 512;
  constexpr std::uint64_t number = Draft::kLongestText + 3;  // a blank, a share of keyword and end
  constexpr std::uint64_t id = 9;                            // with a blank; no id has more digits
  const std::uint64_t numbers = mesh.positions.size();
  const std::uint64_t faces = mesh.face_count();
  const std::uint64_t corners = mesh.face_vertices.size();
  const std::uint64_t colors = mesh.colors.size();
  const std::uint64_t textured = mesh.corner_texcoords.size();
  switch (format) {
    case FileFormat::obj:
      return header + number * (numbers + mesh.texcoords.size()) + 6 * colors + id * (corners + textured) + 2 * faces;
    case FileFormat::ply:
      return header + 8 * numbers + colors + 4 * corners + 16 * textured + 8 * faces;
    case FileFormat::off:
      return header + number * numbers + 4 * colors + id * corners + 12 * faces;
    case FileFormat::stl:
      return header + 50 * std::uint64_t{triangle_ids / 3};
    case FileFormat::xyz:
      return header + number * numbers;
  }
  return 0;
}

Status check_positions(std::span<const double> positions) {
  if (positions.empty() || positions.size() % 3 != 0) {
    return invalid({"positions has ", positions.size(), " numbers; expected 3 a vertex and at least one vertex"});
  }
  if (positions.size() / 3 > kMaxVertices) {
    return too_large({"the shape has ", positions.size() / 3, " vertices; expected at most ", kMaxVertices});
  }
  return check_finite(positions, "positions");
}

/// Reads polygons as (count, ids...) into the mesh.
Status take_polygons(std::span<const std::int32_t> polygons, PolygonMesh& mesh) {
  if (polygons.size() > PolygonCollector::kMaxCorners) {
    return too_large({"polygons has ", polygons.size(), " numbers; expected at most ", PolygonCollector::kMaxCorners});
  }
  for (std::size_t at = 0; at < polygons.size();) {
    const std::int32_t corners = polygons[at++];
    const std::string name = message({"polygon ", mesh.face_count()});
    if (corners < 3 || static_cast<std::size_t>(corners) > polygons.size() - at) {
      return invalid({name, " has a count of ", corners, "; expected at least 3 corners, all of them in the list"});
    }
    for (const std::int32_t id : polygons.subspan(at, static_cast<std::size_t>(corners))) {
      if (id < 0 || static_cast<std::size_t>(id) >= mesh.vertex_count()) {
        return invalid(
            {name, " refers to vertex ", id, "; the shape has ", mesh.vertex_count(), " vertices, counted from 0"});
      }
      mesh.face_vertices.push_back(static_cast<std::uint32_t>(id));
    }
    at += static_cast<std::size_t>(corners);
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.face_vertices.size()));
  }
  return {};
}

}  // namespace

/// A file of which a part has been read.
struct Document::Reading {
  FileFormat format;
  Bytes bytes;
  PolygonCollector polygons;
  std::unique_ptr<Scanner> scanner;
  std::vector<double> positions;
  Draft draft{{.soft_limit = kPieceSize}};
  std::size_t at = 0;

  Reading(FileFormat file_format, Bytes file)
      : format(file_format), bytes(std::move(file)), scanner(make_scanner(format, &polygons)) {}

  Status scan();
};

Document::Document() = default;
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Status Document::read(FileFormat format, Bytes bytes) {
  Status begun = begin(format, std::move(bytes));
  while (begun.ok() && reading_) {
    begun = advance().status();
  }
  return begun;
}

Status Document::begin(FileFormat format, Bytes bytes) {
  reading_.reset();
  if (bytes.size() > kMaxBytes) {
    return too_large({"the file has ", bytes.size(), " bytes; at most ", kMaxBytes, " can be read whole"});
  }
  reading_ = std::make_unique<Reading>(format, std::move(bytes));
  return {};
}

Result<double> Document::advance() {
  if (!reading_) {
    return Status(ErrorCode::invalid_option, "no file is being read; begin one first");
  }
  Reading& reading = *reading_;
  const bool ended = reading.at == reading.bytes.size();
  Status status = ended ? finish_reading() : reading.scan();
  if (!status.ok() || ended) {
    reading_.reset();
  }
  if (!status.ok()) {
    return status;
  }
  // All bytes are read before the polygons are cut into triangles: the last hundredth.
  return ended ? 1.0 : 0.99 * static_cast<double>(reading.at) / static_cast<double>(reading.bytes.size());
}

Status Document::Reading::scan() {
  draft.clear();
  const Result<std::size_t> taken = scanner->scan(text_of(bytes).substr(at), true, draft);
  if (!taken.ok()) {
    return taken.status();
  }
  at += *taken;
  positions.insert(positions.end(), draft.points().begin(), draft.points().end());
  if (positions.size() / 3 > kMaxVertices || polygons.too_large()) {
    return too_large({scanner->place(), ": more than ", kMaxVertices, " vertices, ", PolygonCollector::kMaxCorners,
                      " corners of faces (", PolygonCollector::kMaxTexturedCorners, " with texture coordinates) or ",
                      PolygonCollector::kMaxTexcoords, " texture coordinates"});
  }
  return {};
}

Status Document::finish_reading() {
  Status status = reading_->scanner->finish();
  if (!status.ok()) {
    return status;
  }
  mesh_ = reading_->polygons.take();
  mesh_.positions = std::move(reading_->positions);
  triangles_ = triangulate(mesh_);
  source_ = std::move(reading_->bytes);
  format_ = reading_->format;
  return {};
}

Status Document::assign(std::span<const double> positions, std::span<const std::int32_t> polygons) {
  Status checked = check_positions(positions);
  if (!checked.ok()) {
    return checked;
  }
  PolygonMesh mesh;
  mesh.positions.assign(positions.begin(), positions.end());
  Status taken = take_polygons(polygons, mesh);
  if (!taken.ok()) {
    return taken;
  }
  mesh_ = std::move(mesh);
  triangles_ = triangulate(mesh_);
  source_ = Bytes();
  return {};
}

Status Document::assign_texcoords(std::span<const double> texcoords) {
  const std::size_t corners = mesh_.face_vertices.size();
  if (texcoords.size() != 2 * corners) {
    return invalid(
        {"texture coordinates has ", texcoords.size(), " numbers; expected 2 for each of ", corners, " corners"});
  }
  Status finite = check_finite(texcoords, "texture coordinates");
  if (!finite.ok()) {
    return finite;
  }
  mesh_.texcoords.assign(texcoords.begin(), texcoords.end());
  mesh_.corner_texcoords.resize(corners);
  for (std::size_t c = 0; c < corners; ++c) {
    mesh_.corner_texcoords[c] = static_cast<std::uint32_t>(c);
  }
  return {};
}

Status Document::assign_colors(std::span<const std::uint8_t> colors) {
  if (colors.size() != 3 * mesh_.vertex_count()) {
    return invalid(
        {"colors has ", colors.size(), " numbers; expected 3 for each of ", mesh_.vertex_count(), " vertices"});
  }
  mesh_.colors.assign(colors.begin(), colors.end());
  return {};
}

Result<Bytes> Document::write(FileFormat format, std::span<const double> positions) const {
  if (mesh_.positions.empty()) {
    return invalid({"the document is empty; read or assign one first"});
  }
  Status checked = check_positions(positions);
  if (!checked.ok()) {
    return checked;
  }
  if (positions.size() != mesh_.positions.size()) {
    return invalid({"positions has ", positions.size() / 3, " vertices; the document has ", mesh_.vertex_count()});
  }
  if (format == format_ && !source_.empty()) {
    return rewrite(positions);
  }
  return convert(format, positions);
}

/// The Rewriter's way, over bytes that are all here: the scanner stops where the draft is full.
Result<Bytes> Document::rewrite(std::span<const double> positions) const {
  Bytes out;
  const std::unique_ptr<Scanner> scanner = make_scanner(format_, nullptr);
  const std::string_view text = text_of(source_);
  Draft draft({.soft_limit = kPieceSize});
  std::size_t done = 0;
  for (std::size_t at = 0; at < text.size();) {
    draft.clear();
    const Result<std::size_t> taken = scanner->scan(text.substr(at), true, draft);
    if (!taken.ok()) {
      return taken.status();
    }
    at += *taken;
    if (out.capacity() == 0) {  // the first piece has shown how numbers are written
      Status reserved = reserve(out, std::uint64_t{source_.size()} + draft.longest_number() * positions.size());
      if (!reserved.ok()) {
        return reserved;
      }
    }
    const std::size_t found = draft.points().size();
    Status status = draft.emit(positions.subspan(done, found), out);
    if (!status.ok()) {
      return status;
    }
    done += found;
  }
  return out;
}

Result<Bytes> Document::convert(FileFormat format, std::span<const double> positions) const {
  Bytes out;
  Status reserved = reserve(out, size_bound(format, mesh_, triangles_.size()));
  if (!reserved.ok()) {
    return reserved;
  }
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
  if (!status.ok()) {
    return status;
  }
  return out;
}

}  // namespace pliant::io
