#include "pliant/io/off.h"

#include <optional>
#include <string>

#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

std::string_view without_last_words(std::string_view words, int count) {
  std::size_t end = words.size();
  for (; count > 0; --count) {
    while (end > 0 && is_blank(words[end - 1])) --end;
    while (end > 0 && !is_blank(words[end - 1])) --end;
  }
  return words.substr(0, end);
}

class OffScanner final : public LineScanner {
 public:
  explicit OffScanner(PolygonCollector* polygons) : polygons_(polygons) {}

  Status finish() override;

 private:
  enum class Expected { header, counts, vertices, faces, nothing };

  Status scan_line(std::string_view line, Draft& draft) override;
  Status scan_header(std::string_view line, Draft& draft);
  Status scan_counts(std::string_view words);
  Status scan_vertex(std::string_view line, Draft& draft);
  Status read_vertex_texcoord(std::string_view words);
  Status read_face(std::string_view words);

  PolygonCollector* polygons_;
  Expected expected_ = Expected::header;
  bool has_colors_ = false;
  bool has_normals_ = false;
  bool has_texcoords_ = false;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  std::uint64_t faces_ = 0;
};

Status OffScanner::scan_line(std::string_view line, Draft& draft) {
  const std::string_view words = without_comment(line);
  std::size_t at = 0;
  if (next_word(words, at).empty()) {
    draft.keep(line);
    return {};
  }
  switch (expected_) {
    case Expected::header:
      return scan_header(line, draft);
    case Expected::counts:
      draft.keep(line);
      return scan_counts(words);
    case Expected::vertices:
      return scan_vertex(line, draft);
    case Expected::faces:
      draft.keep(line);
      return read_face(words);
    case Expected::nothing:
      draft.keep(line);
      return {};
  }
  return {};
}

/// "OFF" with its prefixes; some files go on with the counts, even without a blank.
Status OffScanner::scan_header(std::string_view line, Draft& draft) {
  std::size_t at = 0;
  const std::string_view word = next_word(line, at);
  std::size_t length = 0;
  const auto take = [&](std::string_view prefix) {
    const bool found = word.substr(length).starts_with(prefix);
    if (found) {
      length += prefix.size();
    }
    return found;
  };
  has_texcoords_ = take("ST");
  has_colors_ = take("C");
  const std::size_t normal_letter = length;
  has_normals_ = take("N");
  if (!take("OFF")) {
    return failure({"expected OFF, COFF, NOFF or STOFF, found ", quoted(word)});
  }
  const std::size_t start = at - word.size();
  draft.keep(line.substr(0, start + normal_letter));
  draft.keep(line.substr(start + length - 3, 3));
  if (word.size() > length) {
    draft.keep(" ");  // few readers take counts that begin within the word
  }
  draft.keep(line.substr(start + length));
  const std::string_view rest = without_comment(line.substr(start + length));
  std::size_t rest_at = 0;
  expected_ = Expected::counts;
  return next_word(rest, rest_at).empty() ? Status() : scan_counts(rest);
}

Status OffScanner::scan_counts(std::string_view words) {
  std::size_t at = 0;
  for (std::uint64_t* count : {&vertex_count_, &face_count_}) {
    const std::string_view word = next_word(words, at);
    const std::optional<std::uint64_t> value = read_count(word);
    if (!value) {
      return failure({"expected the numbers of vertices and faces, found ", quoted(word)});
    }
    *count = *value;
  }
  expected_ = vertex_count_ == 0 ? Expected::nothing : Expected::vertices;
  return {};
}

Status OffScanner::scan_vertex(std::string_view line, Draft& draft) {
  std::size_t kept = 0;
  std::size_t at = 0;
  Status status = take_point(line, kept, at, draft);
  if (!status.ok()) {
    return status;
  }
  const std::string_view words = without_comment(line);
  for (int i = 0; has_normals_ && i < 3; ++i) {
    if (next_word(words, at).empty()) {
      return failure({"expected 3 numbers of a normal"});
    }
  }
  // A comment may follow the normal at once; a number it would belong to.
  if (has_normals_ && at < line.size() && line[at] == '#') {
    draft.keep(" ");
  }
  draft.keep(line.substr(at));
  if (vertices_ == vertex_count_) {
    expected_ = face_count_ == 0 ? Expected::nothing : Expected::faces;
  }
  if (!polygons_) {
    return {};
  }
  std::string_view color = words.substr(at);
  if (has_texcoords_) {
    Status read = read_vertex_texcoord(color);
    if (!read.ok()) {
      return read;
    }
  }
  double rgb[3];
  if (has_colors_ && read_color(has_texcoords_ ? without_last_words(color, 2) : color, rgb)) {
    polygons_->color(vertices_ - 1, rgb);
  }
  return {};
}

/// Colours of three or four columns may stand before them, so these are the last two.
Status OffScanner::read_vertex_texcoord(std::string_view words) {
  std::optional<double> uv[2];
  std::size_t at = 0;
  for (std::string_view word = next_word(words, at); !word.empty(); word = next_word(words, at)) {
    uv[0] = uv[1];
    uv[1] = read_number(word);
  }
  if (!uv[0] || !uv[1]) {
    return failure({"expected 2 finite texture coordinates at the end"});
  }
  polygons_->texcoord(*uv[0], *uv[1]);
  return {};
}

Status OffScanner::read_face(std::string_view words) {
  if (++faces_ == face_count_) {
    expected_ = Expected::nothing;
  }
  if (!polygons_) {
    return {};
  }
  std::size_t at = 0;
  const std::string_view first = next_word(words, at);
  const std::optional<std::uint64_t> corners = read_count(first);
  if (!corners) {
    return failure({"expected the number of corners, found ", quoted(first)});
  }
  for (std::uint64_t i = 0; i < *corners; ++i) {
    const std::string_view word = next_word(words, at);
    if (word.empty()) {
      return failure({"face has ", i, " corners; expected ", *corners});
    }
    const std::optional<std::uint64_t> id = read_count(word);
    if (!id || *id >= vertex_count_) {
      return failure({"face refers to vertex ", quoted(word), "; expected ids from 0 to ", vertex_count_ - 1});
    }
    const auto vertex = static_cast<std::uint32_t>(*id);
    polygons_->corner(vertex, has_texcoords_ ? vertex : PolygonMesh::kNoTexcoord, line_);
  }
  polygons_->end_polygon();
  return {};
}

Status OffScanner::finish() {
  const auto ends_early = [this](std::uint64_t found, std::uint64_t count, const char* what) {
    return failure({"the file ends after ", found, " of ", count, " ", what});
  };
  switch (expected_) {
    case Expected::header:
      return failure({"expected OFF, found the end of the file"});
    case Expected::counts:
      return failure({"expected the numbers of vertices and faces"});
    case Expected::vertices:
      return ends_early(vertices_, vertex_count_, "vertices");
    case Expected::faces:
      return ends_early(faces_, face_count_, "faces");
    case Expected::nothing:
      break;
  }
  Status vertices_found = require_vertices(vertices_);
  return vertices_found.ok() && polygons_ ? polygons_->finish(vertices_, "line", 0) : vertices_found;
}

}  // namespace

std::unique_ptr<Scanner> make_off_scanner(PolygonCollector* polygons) { return std::make_unique<OffScanner>(polygons); }

void write_off(const PolygonMesh& mesh, std::span<const double> positions, Bytes& out) {
  append(out, mesh.colors.empty() ? "OFF\n" : "COFF\n");
  append_count(out, mesh.vertex_count());
  out.push_back(' ');
  append_count(out, mesh.face_count());
  append(out, " 0\n");
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    append_numbers(out, &positions[3 * v], 3);
    for (std::size_t c = 3 * v; c < 3 * v + 3 && c < mesh.colors.size(); ++c) {
      out.push_back(' ');
      append_count(out, mesh.colors[c]);
    }
    out.push_back('\n');
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    append_count(out, mesh.face_offsets[f + 1] - mesh.face_offsets[f]);
    for (std::uint32_t c = mesh.face_offsets[f]; c < mesh.face_offsets[f + 1]; ++c) {
      out.push_back(' ');
      append_count(out, mesh.face_vertices[c]);
    }
    out.push_back('\n');
  }
}

}  // namespace pliant::io
