#include "pliant/io/obj.h"

#include <optional>
#include <string>
#include <vector>

#include "pliant/core/message.h"
#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"
#include "pliant/io/obj_faces.h"

namespace pliant::io {
namespace {

/// Gathers `f` lines for tinyobjloader and passes what it read to the collector.
class ObjFaceReader final : public ObjFaceVisitor {
 public:
  explicit ObjFaceReader(PolygonCollector& polygons) : polygons_(polygons) {}

  /// The words of an `f` line behind the keyword, and where it stands.
  Status add(std::string_view words, std::uint64_t line, std::uint64_t vertices_before);
  /// Reads what was gathered. Errors: parse_error.
  Status flush();

 private:
  struct Origin {
    std::uint64_t line;
    std::uint64_t vertices, texcoords;  ///< before the line: what negative ids count back from
  };

  void face(std::span<const ObjCorner> corners) override;
  /// The id from zero up; nothing and an error for 0 and for ids before the first.
  std::optional<std::uint32_t> resolve(int id, const char* kind, std::uint64_t before);

  PolygonCollector& polygons_;
  std::string statements_;
  std::vector<Origin> origins_;
  std::size_t current_ = 0;
  Status error_;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether tinyobjloader reads the corner as it stands: it would take "x" for 0, 4294967297 for 1
/// and the 2 of "1/ 2" for a texture coordinate.
bool is_readable_corner(std::string_view word) {
  constexpr std::size_t most_digits = 9;  // an int has room for any
  std::size_t digits = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool starts = i == 0 || word[i - 1] == '/';
    digits = is_digit(word[i]) ? digits + 1 : 0;
    if (digits > most_digits) {
      return false;
    }
    if (digits > 0 || (word[i] == '/' && i > 0)) {
      continue;
    }
    const bool sign = word[i] == '-' || word[i] == '+';
    if (!sign || !starts || i + 1 == word.size() || !is_digit(word[i + 1])) {
      return false;
    }
  }
  return is_digit(word.back());
}

Status ObjFaceReader::add(std::string_view words, std::uint64_t line, std::uint64_t vertices_before) {
  constexpr std::size_t batch = 1 << 16;
  const auto fail = [line](Words reason) {
    return Status(ErrorCode::parse_error, message({"line ", line, ": ", message(reason)}));
  };
  words = without_comment(words);
  statements_ += "f";
  std::size_t at = 0;
  int corners = 0;
  for (std::string_view word = next_word(words, at); !word.empty(); word = next_word(words, at)) {
    if (!is_readable_corner(word)) {
      return fail({"face corner is ", quoted(word), "; expected vertex ids, as in 1/2/3"});
    }
    (statements_ += ' ') += word;
    ++corners;
  }
  statements_ += '\n';
  if (corners < 3) {
    return fail({"face has ", corners, " corners; expected at least 3"});
  }
  origins_.push_back({line, vertices_before, polygons_.texcoord_count()});
  return statements_.size() < batch ? Status() : flush();
}

Status ObjFaceReader::flush() {
  current_ = 0;
  read_obj_faces(statements_, *this);
  statements_.clear();
  origins_.clear();
  return error_;
}

std::optional<std::uint32_t> ObjFaceReader::resolve(int id, const char* kind, std::uint64_t before) {
  if (id > 0) {
    return static_cast<std::uint32_t>(id - 1);
  }
  const std::uint64_t back = 0 - static_cast<std::uint64_t>(std::int64_t{id});
  if (id < 0 && back <= before) {
    return static_cast<std::uint32_t>(before - back);
  }
  const std::string reason = id == 0 ? "; ids count from 1" : message({"; ", before, " stand before it"});
  error_ = {ErrorCode::parse_error,
            message({"line ", origins_[current_].line, ": face refers to ", kind, " ", id, reason})};
  return std::nullopt;
}

void ObjFaceReader::face(std::span<const ObjCorner> corners) {
  const Origin& origin = origins_[current_];
  for (const ObjCorner& corner : corners) {
    if (!error_.ok()) {
      return;
    }
    const auto vertex = resolve(corner.vertex, "vertex", origin.vertices);
    std::optional<std::uint32_t> texcoord = PolygonMesh::kNoTexcoord;
    if (corner.texcoord != 0) {
      texcoord = resolve(corner.texcoord, "texture coordinate", origin.texcoords);
    }
    if (vertex && texcoord) {
      polygons_.corner(*vertex, *texcoord, origin.line);
    }
  }
  polygons_.end_polygon();
  ++current_;
}

class ObjScanner final : public LineScanner {
 public:
  explicit ObjScanner(PolygonCollector* polygons) : polygons_(polygons) {
    if (polygons_) {
      faces_.emplace(*polygons_);
    }
  }

  Status finish() override;

 private:
  bool continues(std::string_view line) const override;
  Status scan_line(std::string_view line, Draft& draft) override;
  Status read_texcoord(std::string_view line, std::size_t at);
  static void keep_without_normals(std::string_view line, std::size_t at, Draft& draft);
  /// Without a collector, which looks at all ids in the end.
  Status check_face(std::string_view words);

  PolygonCollector* polygons_;
  std::optional<ObjFaceReader> faces_;
  std::uint64_t largest_id_ = 0;  ///< of the faces' vertices, and where it stands
  std::uint64_t largest_line_ = 0;
};

/// Statements of numbers continue behind a backslash; a name or a comment may simply end with one.
bool ObjScanner::continues(std::string_view line) const {
  std::size_t end = line.size();
  while (end > 0 && (line[end - 1] == '\n' || line[end - 1] == '\r')) {
    --end;
  }
  if (end == 0 || line[end - 1] != '\\') {
    return false;
  }
  std::size_t at = 0;
  const std::string_view keyword = next_word(line, at);
  return keyword.starts_with('v') || keyword == "f";
}

Status ObjScanner::scan_line(std::string_view line, Draft& draft) {
  std::size_t at = 0;
  const std::string_view keyword = next_word(line, at);
  if (keyword == "v") {
    std::size_t kept = 0;
    Status status = take_point(line, kept, at, draft);
    draft.keep(line.substr(kept));
    double rgb[3];
    if (status.ok() && polygons_ && read_color(without_comment(line.substr(at)), rgb)) {
      polygons_->color(vertices_ - 1, rgb);
    }
    return status;
  }
  if (keyword == "vn") {
    return {};
  }
  if (keyword == "f") {
    keep_without_normals(line, at, draft);
    return faces_ ? faces_->add(line.substr(at), line_, vertices_) : check_face(without_comment(line.substr(at)));
  }
  draft.keep(line);
  if (keyword == "vt" && polygons_) {
    return read_texcoord(line, at);
  }
  return {};
}

Status ObjScanner::check_face(std::string_view words) {
  std::size_t at = 0;
  for (std::string_view word = next_word(words, at); !word.empty(); word = next_word(words, at)) {
    if (!is_readable_corner(word)) {
      return failure({"face corner is ", quoted(word), "; expected vertex ids, as in 1/2/3"});
    }
    const bool negative = word.front() == '-';
    word.remove_prefix(negative || word.front() == '+' ? 1 : 0);
    const std::uint64_t id = *read_count(word.substr(0, word.find('/')));
    if (id == 0) {
      return failure({"face refers to vertex 0; ids count from 1"});
    }
    if (negative && id > vertices_) {
      return failure({"face refers to vertex -", id, "; ", vertices_, " stand before it"});
    }
    if (!negative && id > largest_id_) {
      largest_id_ = id;
      largest_line_ = line_;
    }
  }
  return {};
}

/// "vt u [v [w]]": v is 0 where there is none.
Status ObjScanner::read_texcoord(std::string_view line, std::size_t at) {
  line = without_comment(line);
  double uv[2] = {0.0, 0.0};
  for (int i = 0; i < 2; ++i) {
    const std::string_view word = next_word(line, at);
    if (word.empty() && i == 1) {
      break;
    }
    const std::optional<double> value = read_number(word);
    if (!value) {
      return failure({"texture coordinate is ", quoted(word), "; expected a finite decimal number"});
    }
    uv[i] = *value;
  }
  polygons_->texcoord(uv[0], uv[1]);
  return {};
}

void ObjScanner::keep_without_normals(std::string_view line, std::size_t at, Draft& draft) {
  const std::string_view words = without_comment(line);
  std::size_t kept = 0;
  while (true) {
    const std::string_view word = next_word(words, at);
    if (word.empty()) {
      break;
    }
    const std::size_t first = word.find('/');
    if (first == std::string_view::npos) {
      continue;
    }
    const std::size_t second = word.find('/', first + 1);
    if (second == std::string_view::npos) {
      continue;
    }
    const std::size_t length = second == first + 1 ? first : second;
    draft.keep(line.substr(kept, at - word.size() + length - kept));
    kept = at;
  }
  draft.keep(line.substr(kept));
}

Status ObjScanner::finish() {
  Status vertices_found = require_vertices(vertices_);
  if (!vertices_found.ok()) {
    return vertices_found;
  }
  if (largest_id_ > vertices_) {
    return {ErrorCode::parse_error, message({"line ", largest_line_, ": face refers to vertex ", largest_id_,
                                             "; the file has ", vertices_, " vertices"})};
  }
  if (!faces_) {
    return {};
  }
  Status faces_read = faces_->flush();
  return faces_read.ok() ? polygons_->finish(vertices_, "line", 1) : faces_read;
}

}  // namespace

std::unique_ptr<Scanner> make_obj_scanner(PolygonCollector* polygons) { return std::make_unique<ObjScanner>(polygons); }

/// A byte as a fraction of 255, with as many digits as it takes to tell it from the next.
void append_channel(Bytes& out, std::uint8_t value) {
  append(out, value == 255 ? " 1." : " 0.");
  const unsigned thousandths = value == 255 ? 0U : (1000U * value + 127U) / 255U;
  for (const unsigned unit : {100U, 10U, 1U}) {
    out.push_back(static_cast<std::uint8_t>('0' + thousandths / unit % 10));
  }
}

void write_obj(const PolygonMesh& mesh, std::span<const double> positions, Bytes& out) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    append(out, "v ");
    append_numbers(out, &positions[3 * v], 3);
    for (std::size_t c = 3 * v; c < 3 * v + 3 && c < mesh.colors.size(); ++c) {
      append_channel(out, mesh.colors[c]);
    }
    out.push_back('\n');
  }
  for (std::size_t t = 0; t < mesh.texcoords.size(); t += 2) {
    append(out, "vt ");
    append_numbers(out, &mesh.texcoords[t], 2);
    out.push_back('\n');
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    out.push_back('f');
    for (std::uint32_t c = mesh.face_offsets[f]; c < mesh.face_offsets[f + 1]; ++c) {
      out.push_back(' ');
      append_count(out, std::uint64_t{mesh.face_vertices[c]} + 1);
      if (mesh.corner_texcoords.empty()) {
        continue;
      }
      if (mesh.corner_texcoords[c] == PolygonMesh::kNoTexcoord) {
        continue;
      }
      out.push_back('/');
      append_count(out, std::uint64_t{mesh.corner_texcoords[c]} + 1);
    }
    out.push_back('\n');
  }
}

}  // namespace pliant::io
