#include "pliant/io/ply.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"
#include "pliant/io/ply_header.h"
#include "pliant/io/ply_record.h"
#include "pliant/io/scanner.h"

namespace pliant::io {
namespace {

bool names_vertices(const PlyProperty& property) {
  return property.role == PlyRole::corners || property.role == PlyRole::strips;
}

class PlyScanner final : public Scanner {
 public:
  explicit PlyScanner(PolygonCollector* polygons) : polygons_(polygons) {}

  Result<std::size_t> scan(std::string_view input, bool last, Draft& draft) override;
  Status finish() override;
  std::string place() const override { return message({is_text() ? "line " : "byte ", where_}); }

 private:
  bool is_text() const { return !header_ || header_->encoding == PlyEncoding::ascii; }
  bool is_big_endian() const { return header_->encoding == PlyEncoding::binary_big; }

  Result<std::size_t> scan_header(std::string_view input, bool last, Draft& draft);
  void set_up(Draft& draft);
  /// The bytes of the record taken from the front of the input; 0 when it is incomplete.
  Result<std::size_t> scan_record(std::string_view input, bool last, Draft& draft);
  /// Many binary records at once, of an element of which nothing is asked.
  Result<std::size_t> keep_records(std::string_view input, Draft& draft);
  Result<std::size_t> read_text(const PlyElement& element, std::string_view input, bool last);
  Result<std::size_t> read_binary(const PlyElement& element, std::string_view input);
  Status take_record(const PlyElement& element, std::string_view bytes, Draft& draft);
  Status take_vertex(const PlyElement& element, std::string_view bytes, Draft& draft);
  Status check_ids(const PlyElement& element) const;
  Status take_polygons(const PlyElement& element);
  Status add_polygon(std::span<const double> ids, std::span<const double> texcoords);
  Status add_strips(std::span<const double> ids);
  Result<std::uint32_t> vertex_id(double value) const;
  void skip_finished_elements();
  Status ends_early() const;

  PolygonCollector* polygons_;
  std::optional<PlyHeader> header_;
  std::uint64_t where_ = 1;  ///< line, or byte in a binary body
  std::size_t element_ = 0;
  std::uint64_t index_ = 0;  ///< record within the element
  std::uint64_t vertices_ = 0;
  std::vector<bool> passes_;          ///< elements whose binary records are kept as they are
  std::vector<bool> has_lists_;       ///< elements whose records differ in length
  std::vector<bool> names_vertices_;  ///< elements with vertex ids
  std::uint64_t vertex_count_ = 0;    ///< as the header has it
  bool vertex_texcoords_ = false;
  bool vertex_colors_ = false;
  bool blank_ = false;  ///< the line read was blank
  PlyRecord record_;
};

Result<std::size_t> PlyScanner::scan(std::string_view input, bool last, Draft& draft) {
  std::size_t at = 0;
  if (!header_) {
    Result<std::size_t> size = scan_header(input, last, draft);
    if (!size.ok() || *size == 0) {
      return size;
    }
    at = *size;
  }
  while (!draft.full()) {
    skip_finished_elements();
    if (element_ == header_->elements.size()) {  // what follows the elements stays
      draft.keep(input.substr(at));
      return input.size();
    }
    const std::string_view rest = input.substr(at);
    Result<std::size_t> size = passes_[element_] ? keep_records(rest, draft) : scan_record(rest, last, draft);
    if (!size.ok()) {
      return size;
    }
    if (*size == 0) {
      return last ? Result<std::size_t>(ends_early()) : at;
    }
    at += *size;
  }
  return at;
}

Result<std::size_t> PlyScanner::scan_header(std::string_view input, bool last, Draft& draft) {
  constexpr std::string_view magic = "ply";
  if (!magic.starts_with(input.substr(0, magic.size()))) {
    std::size_t at = 0;
    return failure({"expected ply, found ", quoted(next_word(input, at))});
  }
  const std::size_t size = ply_header_size(input);
  if (size == 0) {
    if (!last) {
      return std::size_t{0};
    }
    return failure({"the header has no end_header line"});
  }
  Result<PlyHeader> header = parse_ply_header(input.substr(0, size), draft.options().normals);
  if (!header.ok()) {
    return header.status();
  }
  header_ = std::move(*header);
  where_ = is_text() ? header_->lines + 1 : size;
  set_up(draft);
  return size;
}

void PlyScanner::set_up(Draft& draft) {
  draft.keep(header_->rewritten);
  std::uint32_t roles = 0;
  const auto has = [&roles](PlyRole role) { return (roles >> static_cast<int>(role) & 1) != 0; };
  for (PlyElement& element : header_->elements) {
    for (PlyProperty& property : element.properties) {
      // Without a collector nobody asks for what is not a coordinate.
      if (!polygons_ && property.role > PlyRole::nz && !names_vertices(property)) {
        property.role = PlyRole::keep;
      }
      roles |= 1U << static_cast<int>(property.role);
    }
  }
  for (const PlyElement& element : header_->elements) {
    const bool is_vertex = element.name == "vertex";
    const auto is_kept = [&](const PlyProperty& property) {
      return property.role == PlyRole::keep || (!polygons_ && !is_vertex);
    };
    names_vertices_.push_back(std::any_of(element.properties.begin(), element.properties.end(), names_vertices));
    vertex_count_ = is_vertex ? element.count : vertex_count_;
    const auto is_list = [](const PlyProperty& property) { return property.is_list; };
    has_lists_.push_back(std::any_of(element.properties.begin(), element.properties.end(), is_list));
    passes_.push_back(!is_text() && std::all_of(element.properties.begin(), element.properties.end(), is_kept));
  }
  constexpr NumberStyle styles[] = {NumberStyle::text, NumberStyle::double_little, NumberStyle::double_big};
  draft.set_style(styles[static_cast<int>(header_->encoding)]);
  vertex_texcoords_ = has(PlyRole::u) && has(PlyRole::v);
  vertex_colors_ = has(PlyRole::red) && has(PlyRole::green) && has(PlyRole::blue);
}

Result<std::size_t> PlyScanner::scan_record(std::string_view input, bool last, Draft& draft) {
  const PlyElement& element = header_->elements[element_];
  blank_ = false;
  Result<std::size_t> size = is_text() ? read_text(element, input, last) : read_binary(element, input);
  if (!size.ok() || *size == 0) {
    return size;
  }
  const std::string_view bytes = input.substr(0, *size);
  if (blank_) {
    draft.keep(bytes);
  } else {
    Status status = take_record(element, bytes, draft);
    if (!status.ok()) {
      return status;
    }
    ++index_;
  }
  where_ += is_text() ? 1 : bytes.size();
  return size;
}

Result<std::size_t> PlyScanner::keep_records(std::string_view input, Draft& draft) {
  constexpr std::size_t enough = 1 << 16;  // the draft may be full then
  const PlyElement& element = header_->elements[element_];
  std::string error;
  std::size_t at = 0;
  while (at < enough && index_ < element.count) {
    const std::size_t size = ply_record_size(element, is_big_endian(), input.substr(at), error);
    if (size == 0) {
      break;
    }
    if (names_vertices_[element_]) {
      lay_out_binary_record(element, is_big_endian(), input.substr(at), record_);
      load_binary_record(element, is_big_endian(), input.substr(at), record_);
      Status checked = check_ids(element);
      if (!checked.ok()) {
        return checked;
      }
    }
    at += size;
    where_ += size;
    ++index_;
  }
  draft.keep(input.substr(0, at));
  return error.empty() ? Result<std::size_t>(at) : failure({error});
}

Result<std::size_t> PlyScanner::read_text(const PlyElement& element, std::string_view input, bool last) {
  const std::size_t end = line_end(input, 0, last);
  if (end == std::string_view::npos || end == 0) {
    return std::size_t{0};
  }
  const std::string_view line = input.substr(0, end);
  std::size_t at = 0;
  blank_ = next_word(line, at).empty();
  const bool is_read = polygons_ || element.name == "vertex" || names_vertices_[element_];
  if (blank_ || !is_read) {
    return end;
  }
  const std::string error = read_text_record(element, line, record_);
  if (!error.empty()) {
    return failure({error});
  }
  return end;
}

Result<std::size_t> PlyScanner::read_binary(const PlyElement& element, std::string_view input) {
  const bool known = index_ > 0 && !has_lists_[element_];
  std::string error;
  const std::size_t size = known ? record_.fields.back().end : ply_record_size(element, is_big_endian(), input, error);
  if (!error.empty()) {
    return failure({error});
  }
  if (size == 0 || size > input.size()) {
    return std::size_t{0};
  }
  if (!known) {
    lay_out_binary_record(element, is_big_endian(), input, record_);
  }
  load_binary_record(element, is_big_endian(), input, record_);
  return size;
}

Status PlyScanner::take_record(const PlyElement& element, std::string_view bytes, Draft& draft) {
  if (element.name == "vertex") {
    return take_vertex(element, bytes, draft);
  }
  draft.keep(bytes);
  return polygons_ ? take_polygons(element) : check_ids(element);
}

/// Without a collector, which looks at them all in the end.
Status PlyScanner::check_ids(const PlyElement& element) const {
  for (std::size_t i = 0; names_vertices_[element_] && i < record_.fields.size(); ++i) {
    const PlyRole role = element.properties[i].role;
    if (!names_vertices(element.properties[i])) {
      continue;
    }
    const auto& [begin, end, first, count] = record_.fields[i];
    for (std::size_t v = first; v < first + count; ++v) {
      const double value = record_.values[v];
      const bool good = value >= 0.0 && value < static_cast<double>(vertex_count_) && value == std::floor(value);
      if (good || (role == PlyRole::strips && value == -1.0)) {
        continue;
      }
      const Result<std::uint32_t> id = vertex_id(value);
      if (!id.ok()) {
        return id.status();
      }
      return failure({"face refers to vertex ", *id, "; the file has ", vertex_count_, " vertices, counted from 0"});
    }
  }
  return {};
}

/// The number that stands for full light.
double color_unit(PlyType type) {
  constexpr double units[] = {127.0, 255.0, 32767.0, 65535.0, 2147483647.0, 4294967295.0, 1.0, 1.0};
  return units[static_cast<int>(type)];
}

std::size_t component(PlyRole role, PlyRole first) {
  return static_cast<std::size_t>(role) - static_cast<std::size_t>(first);
}

/// Works on lines and on binary records: between the fields of a line stand blanks, between those
/// of a binary record nothing. A dropped field takes the blanks before it along.
Status PlyScanner::take_vertex(const PlyElement& element, std::string_view bytes, Draft& draft) {
  double texcoord[2] = {0.0, 0.0};
  double rgb[3] = {0.0, 0.0, 0.0};
  const std::size_t first = draft.points().size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < record_.fields.size(); ++i) {
    const PlyRecord::Field& field = record_.fields[i];
    const PlyRole role = element.properties[i].role;
    if (role == PlyRole::keep) {
      continue;
    }
    if (role == PlyRole::drop) {
      const std::size_t before = i == 0 ? 0 : record_.fields[i - 1].end;
      if (before > kept) {
        draft.keep(bytes.substr(kept, before - kept));
      }
      kept = field.end;
      continue;
    }
    const double value = record_.values[field.first];
    if (role >= PlyRole::red) {
      rgb[component(role, PlyRole::red)] = value / color_unit(element.properties[i].type);
      continue;
    }
    const bool is_normal = role >= PlyRole::nx && role <= PlyRole::nz;
    if (!is_normal && !std::isfinite(value)) {
      return failure({element.properties[i].name, " of vertex ", index_, " is not finite"});
    }
    if (role > PlyRole::nz) {
      texcoord[role == PlyRole::u ? 0 : 1] = value;
      continue;
    }
    draft.keep(bytes.substr(kept, field.begin - kept));
    kept = field.end;
    if (is_normal) {
      draft.normal(first + component(role, PlyRole::nx), value, element.properties[i].type == PlyType::float32);
    } else if (draft.admits(value)) {
      draft.coordinate(first + component(role, PlyRole::x), value);
    } else {
      return too_far(value, draft);
    }
  }
  draft.keep(bytes.substr(kept));
  if (vertex_colors_) {
    polygons_->color(vertices_, rgb);
  }
  ++vertices_;
  if (vertex_texcoords_) {
    polygons_->texcoord(texcoord[0], texcoord[1]);
  }
  return {};
}

Status PlyScanner::take_polygons(const PlyElement& element) {
  std::span<const double> ids;
  std::span<const double> texcoords;
  bool strips = false;
  for (std::size_t i = 0; i < record_.fields.size(); ++i) {
    const PlyRole role = element.properties[i].role;
    const PlyRecord::Field& field = record_.fields[i];
    const std::span<const double> values(record_.values.data() + field.first, field.count);
    if (role == PlyRole::corners || role == PlyRole::strips) {
      ids = values;
    }
    if (role == PlyRole::corner_texcoords) {
      texcoords = values;
    }
    strips = strips || role == PlyRole::strips;
  }
  return strips ? add_strips(ids) : add_polygon(ids, texcoords);
}

Status PlyScanner::add_polygon(std::span<const double> ids, std::span<const double> texcoords) {
  // Another number of texture coordinates than two a corner (some writers put none) means nothing.
  const bool own_texcoords = !ids.empty() && texcoords.size() == 2 * ids.size();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Result<std::uint32_t> id = vertex_id(ids[i]);
    if (!id.ok()) {
      return id.status();
    }
    std::uint32_t texcoord = vertex_texcoords_ ? *id : PolygonMesh::kNoTexcoord;
    if (own_texcoords && !vertex_texcoords_) {
      if (!std::isfinite(texcoords[2 * i]) || !std::isfinite(texcoords[2 * i + 1])) {
        return failure({"a texture coordinate is not finite"});
      }
      texcoord = polygons_->texcoord_count();
      polygons_->texcoord(texcoords[2 * i], texcoords[2 * i + 1]);
    }
    polygons_->corner(*id, texcoord, where_);
  }
  polygons_->end_polygon();
  return {};
}

/// Every further id makes a triangle with the two before it; each second one is turned around.
Status PlyScanner::add_strips(std::span<const double> ids) {
  std::uint32_t before[2] = {0, 0};
  std::size_t length = 0;
  for (const double value : ids) {
    if (value == -1.0) {
      length = 0;
      continue;
    }
    const Result<std::uint32_t> id = vertex_id(value);
    if (!id.ok()) {
      return id.status();
    }
    if (length >= 2) {
      const std::size_t first = length % 2;
      for (const std::uint32_t corner : {before[first], before[1 - first], *id}) {
        polygons_->corner(corner, vertex_texcoords_ ? corner : PolygonMesh::kNoTexcoord, where_);
      }
      polygons_->end_polygon();
    }
    before[0] = before[1];
    before[1] = *id;
    ++length;
  }
  return {};
}

Result<std::uint32_t> PlyScanner::vertex_id(double value) const {
  constexpr double most = 4294967294.0;  // 32 bits without PolygonMesh::no_texcoord
  if (value >= 0 && value <= most && value == std::floor(value)) {
    return static_cast<std::uint32_t>(value);
  }
  return failure({"face refers to vertex ", value, "; expected whole numbers from 0 up"});
}

void PlyScanner::skip_finished_elements() {
  while (element_ < header_->elements.size() && index_ == header_->elements[element_].count) {
    ++element_;
    index_ = 0;
  }
}

Status PlyScanner::ends_early() const {
  const PlyElement& element = header_->elements[element_];
  return failure({"the file ends after ", index_, " of ", element.count, " records of element ", quoted(element.name)});
}

Status PlyScanner::finish() {
  if (!header_) {
    return failure({"expected ply, found the end of the file"});
  }
  skip_finished_elements();
  if (element_ < header_->elements.size()) {
    return ends_early();
  }
  Status status = require_vertices(vertices_);
  if (!status.ok() || !polygons_) {
    return status;
  }
  return polygons_->finish(vertices_, is_text() ? "line" : "byte", 0);
}

}  // namespace

std::unique_ptr<Scanner> make_ply_scanner(PolygonCollector* polygons) { return std::make_unique<PlyScanner>(polygons); }

void write_ply(const PolygonMesh& mesh, std::span<const double> positions, Bytes& out) {
  const bool textured = !mesh.corner_texcoords.empty();
  // Most readers expect one byte for the length of a list; larger polygons need more.
  std::uint32_t longest = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    longest = std::max(longest, mesh.face_offsets[f + 1] - mesh.face_offsets[f]);
  }
  const bool short_lists = 2 * std::uint64_t{longest} <= 255;
  const std::string list = short_lists ? "property list uchar" : "property list uint";
  const auto store_length = [&out, short_lists](std::uint32_t length) {
    if (short_lists) {
      store(out, static_cast<std::uint8_t>(length), false);
    } else {
      store(out, length, false);
    }
  };
  append(out, "ply\nformat binary_little_endian 1.0\nelement vertex ");
  append_count(out, mesh.vertex_count());
  append(out, "\nproperty double x\nproperty double y\nproperty double z\n");
  if (!mesh.colors.empty()) {
    append(out, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  }
  if (mesh.face_count() > 0) {
    append(out, "element face ");
    append_count(out, mesh.face_count());
    append(out, "\n" + list + " int vertex_indices\n");
    if (textured) {
      append(out, list + " double texcoord\n");
    }
  }
  append(out, "end_header\n");
  for (std::size_t i = 0; i < positions.size(); ++i) {
    store(out, positions[i], false);
    if (i % 3 == 2 && !mesh.colors.empty()) {
      out.insert(out.end(), &mesh.colors[i - 2], &mesh.colors[i - 2] + 3);
    }
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t first = mesh.face_offsets[f];
    const std::uint32_t end = mesh.face_offsets[f + 1];
    store_length(end - first);
    for (std::uint32_t c = first; c < end; ++c) {
      store(out, mesh.face_vertices[c], false);
    }
    if (!textured) {
      continue;
    }
    store_length(2 * (end - first));
    for (std::uint32_t c = first; c < end; ++c) {
      const auto [u, v] = mesh.corner_texcoord(c);
      store(out, u, false);
      store(out, v, false);
    }
  }
}

}  // namespace pliant::io
