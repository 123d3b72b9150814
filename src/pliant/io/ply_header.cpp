#include "pliant/io/ply_header.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

constexpr std::size_t kNpos = std::string_view::npos;

/// The first line says how lines end; in a binary file the byte behind end_header could be any, so
/// the endings cannot be mixed. npos when that is not known yet.
std::size_t header_line_end(std::string_view text, std::size_t at) {
  const std::size_t first = text.find_first_of("\r\n");
  if (first == kNpos || (text[first] == '\r' && first + 1 == text.size())) {
    return kNpos;
  }
  const bool lone_return = text[first] == '\r' && text[first + 1] != '\n';
  const std::size_t end = text.find(lone_return ? '\r' : '\n', at);
  return end == kNpos ? kNpos : end + 1;
}

std::optional<PlyType> type_from_name(std::string_view name) {
  struct Named {
    std::string_view name, alias;
    PlyType type;
  };
  constexpr Named types[] = {{"char", "int8", PlyType::int8},        {"uchar", "uint8", PlyType::uint8},
                             {"short", "int16", PlyType::int16},     {"ushort", "uint16", PlyType::uint16},
                             {"int", "int32", PlyType::int32},       {"uint", "uint32", PlyType::uint32},
                             {"float", "float32", PlyType::float32}, {"double", "float64", PlyType::float64}};
  for (const Named& known : types) {
    if (name == known.name || name == known.alias) {
      return known.type;
    }
  }
  return std::nullopt;
}

PlyRole vertex_role(const PlyProperty& property) {
  struct Named {
    std::string_view name;
    PlyRole role;
  };
  constexpr Named names[] = {{"x", PlyRole::x},         {"y", PlyRole::y},         {"z", PlyRole::z},
                             {"nx", PlyRole::nx},       {"ny", PlyRole::ny},       {"nz", PlyRole::nz},
                             {"u", PlyRole::u},         {"v", PlyRole::v},         {"s", PlyRole::u},
                             {"t", PlyRole::v},         {"texture_u", PlyRole::u}, {"texture_v", PlyRole::v},
                             {"texture_s", PlyRole::u}, {"texture_t", PlyRole::v}, {"red", PlyRole::red},
                             {"green", PlyRole::green}, {"blue", PlyRole::blue}};
  for (const Named& known : names) {
    if (property.name == known.name && !property.is_list) {
      return known.role;
    }
  }
  return PlyRole::keep;
}

PlyRole role_of(const PlyElement& element, const PlyProperty& property) {
  const bool ids = property.name == "vertex_indices" || property.name == "vertex_index";
  if (element.name == "vertex") {
    return vertex_role(property);
  }
  if (!property.is_list) {
    return PlyRole::keep;
  }
  if (element.name == "tristrips" && ids) {
    return PlyRole::strips;
  }
  if (element.name == "face" && ids) {
    return PlyRole::corners;
  }
  if (element.name == "face" && property.name == "texcoord") {
    return PlyRole::corner_texcoords;
  }
  return PlyRole::keep;
}

bool is_normal(const PlyProperty& property) { return property.role >= PlyRole::nx && property.role <= PlyRole::nz; }

/// Whether there are normals, and numbers that a turned one fits.
bool has_normals(const PlyElement& element) {
  const auto& properties = element.properties;
  return std::count_if(properties.begin(), properties.end(), is_normal) == 3 &&
         std::all_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return !is_normal(p) || p.type >= PlyType::float32; });
}

class HeaderParser {
 public:
  Result<PlyHeader> parse(std::string_view text, bool normals);

 private:
  Status failure(Words reason) const {
    return {ErrorCode::parse_error, message({"line ", header_.lines + 1, ": ", message(reason)})};
  }
  Status parse_line(std::string_view line);
  Status parse_format(std::string_view line, std::size_t at);
  Status parse_element(std::string_view line, std::size_t at);
  Status parse_property(std::string_view line, std::size_t at);
  Status check() const;
  void drop_normals();

  PlyHeader header_;
  bool has_format_ = false;
  /// Where lines of normals stand in the rewritten header.
  std::vector<std::pair<std::size_t, std::size_t>> normal_lines_;
};

Result<PlyHeader> HeaderParser::parse(std::string_view text, bool normals) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(header_line_end(text, at), text.size());
    Status status = parse_line(text.substr(at, end - at));
    if (!status.ok()) {
      return status;
    }
    ++header_.lines;
    at = end;
  }
  const auto turned = [](const PlyElement& element) { return has_normals(element); };
  if (!normals || std::none_of(header_.elements.begin(), header_.elements.end(), turned)) {
    drop_normals();
  }
  return std::move(header_);
}

void HeaderParser::drop_normals() {
  for (auto line = normal_lines_.rbegin(); line != normal_lines_.rend(); ++line) {
    header_.rewritten.erase(line->first, line->second);
  }
  for (PlyElement& element : header_.elements) {
    for (PlyProperty& property : element.properties) {
      property.role = is_normal(property) ? PlyRole::drop : property.role;
    }
  }
}

Status HeaderParser::parse_line(std::string_view line) {
  std::size_t at = 0;
  const std::string_view keyword = next_word(line, at);
  if (keyword == "property") {
    return parse_property(line, at);
  }
  header_.rewritten += line;
  if (keyword == "format") {
    return parse_format(line, at);
  }
  if (keyword == "element") {
    return parse_element(line, at);
  }
  if (keyword == "end_header") {
    return check();
  }
  constexpr std::string_view others[] = {"ply", "comment", "obj_info", ""};
  if (std::find(std::begin(others), std::end(others), keyword) != std::end(others)) {
    return {};
  }
  return failure({"found ", quoted(keyword), "; expected format, element, property, comment, obj_info or end_header"});
}

Status HeaderParser::parse_format(std::string_view line, std::size_t at) {
  const std::string_view name = next_word(line, at);
  has_format_ = true;
  if (name == "ascii") {
    header_.encoding = PlyEncoding::ascii;
  } else if (name == "binary_little_endian") {
    header_.encoding = PlyEncoding::binary_little;
  } else if (name == "binary_big_endian") {
    header_.encoding = PlyEncoding::binary_big;
  } else {
    return failure({"format is ", quoted(name), "; expected ascii, binary_little_endian or binary_big_endian"});
  }
  return {};
}

Status HeaderParser::parse_element(std::string_view line, std::size_t at) {
  PlyElement element;
  element.name = next_word(line, at);
  const std::string_view word = next_word(line, at);
  const std::optional<std::uint64_t> count = read_count(word);
  if (!count) {
    return failure({"the count of element ", quoted(element.name), " is ", quoted(word), "; expected a whole number"});
  }
  element.count = *count;
  for (const PlyElement& other : header_.elements) {
    if (other.name == element.name) {
      return failure({"element ", quoted(element.name), " stands twice"});
    }
  }
  header_.elements.push_back(std::move(element));
  return {};
}

Status HeaderParser::parse_property(std::string_view line, std::size_t at) {
  if (header_.elements.empty()) {
    return failure({"property before the first element"});
  }
  PlyElement& element = header_.elements.back();
  PlyProperty property;
  std::string_view type_name = next_word(line, at);
  if (type_name == "list") {
    property.is_list = true;
    const std::string_view count_name = next_word(line, at);
    const std::optional<PlyType> count_type = type_from_name(count_name);
    if (!count_type || *count_type >= PlyType::float32) {
      return failure({"the counts of a list are ", quoted(count_name), "; expected an integer type"});
    }
    property.count_type = *count_type;
    type_name = next_word(line, at);
  }
  const std::size_t type_end = at;
  const std::optional<PlyType> type = type_from_name(type_name);
  if (!type) {
    return failure({"property type is ", quoted(type_name), "; expected float, int, ..."});
  }
  property.type = *type;
  property.name = next_word(line, at);
  if (property.name.empty()) {
    return failure({"property without a name"});
  }
  property.role = role_of(element, property);
  for (const PlyProperty& other : element.properties) {
    if (other.name == property.name) {
      return failure({"property ", quoted(property.name), " stands twice"});
    }
  }
  const bool coordinate = property.role >= PlyRole::x && property.role <= PlyRole::z;
  if (coordinate && property.type != PlyType::float64) {
    header_.rewritten += line.substr(0, type_end - type_name.size());
    (header_.rewritten += "double") += line.substr(type_end);
  } else {
    if (is_normal(property)) {
      normal_lines_.emplace_back(header_.rewritten.size(), line.size());
    }
    header_.rewritten += line;
  }
  element.properties.push_back(std::move(property));
  return {};
}

Status HeaderParser::check() const {
  if (!has_format_) {
    return failure({"the header has no format line"});
  }
  const PlyElement* vertex = nullptr;
  for (const PlyElement& element : header_.elements) {
    if (element.properties.empty() && element.count > 0) {
      return failure({"element ", quoted(element.name), " has no properties"});
    }
    if (element.name == "vertex") {
      vertex = &element;
    }
  }
  if (!vertex) {
    return failure({"the header has no element vertex"});
  }
  for (const PlyRole role : {PlyRole::x, PlyRole::y, PlyRole::z}) {
    const bool found = std::any_of(vertex->properties.begin(), vertex->properties.end(),
                                   [role](const PlyProperty& p) { return p.role == role; });
    const char* names[] = {"x", "y", "z"};
    const int axis = static_cast<int>(role) - static_cast<int>(PlyRole::x);
    if (!found) {
      return failure({"element vertex has no property ", names[axis]});
    }
  }
  return {};
}

}  // namespace

std::size_t ply_size(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::size_t ply_header_size(std::string_view text) {
  std::size_t at = 0;
  while (true) {
    const std::size_t end = header_line_end(text, at);
    if (end == kNpos) {
      return 0;
    }
    std::size_t word_at = 0;
    if (next_word(text.substr(at, end - at), word_at) == "end_header") {
      return end;
    }
    at = end;
  }
}

Result<PlyHeader> parse_ply_header(std::string_view text, bool normals) { return HeaderParser().parse(text, normals); }

}  // namespace pliant::io
