#include "pliant/io/stl.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

constexpr std::size_t kNpos = std::string_view::npos;
constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kFacetSize = 50;

/// The facet of the three vertices that end at `vertices`, as a polygon.
void collect_facet(PolygonCollector* polygons, std::uint64_t vertices, std::uint64_t where) {
  if (!polygons) {
    return;
  }
  for (std::uint64_t v = vertices - 3; v < vertices; ++v) {
    polygons->corner(static_cast<std::uint32_t>(v), PolygonMesh::kNoTexcoord, where);
  }
  polygons->end_polygon();
}

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  return text;
}

/// A record is a line, or all lines from `facet` to `endfacet`: the normal stands before the
/// corners it is computed from.
class TextStlScanner final : public TextScanner {
 public:
  explicit TextStlScanner(PolygonCollector* polygons) : polygons_(polygons) {}

  Result<std::size_t> scan(std::string_view input, bool last, Draft& draft) override;
  Status finish() override { return require_vertices(vertices_); }

 private:
  Status scan_line(std::string_view line, Draft& draft);
  Status scan_facet_line(std::string_view line, std::size_t at, Draft& draft);
  Status scan_vertex(std::string_view line, std::size_t at, Draft& draft);
  Status end_facet();

  PolygonCollector* polygons_;
  bool in_facet_ = false;
  int corners_ = 0;
};

Result<std::size_t> TextStlScanner::scan(std::string_view input, bool last, Draft& draft) {
  std::size_t at = 0;
  while (at < input.size() && !draft.full()) {
    const Draft::Mark mark = draft.mark();
    const std::uint64_t first_line = line_;
    const std::uint64_t vertices_before = vertices_;
    std::size_t end = at;
    do {
      const std::size_t next = end < input.size() ? line_end(input, end, last) : kNpos;
      if (next == kNpos) {
        if (last) {
          return failure({"the file ends inside a facet"});
        }
        draft.rewind(mark);
        line_ = first_line;
        vertices_ = vertices_before;
        in_facet_ = false;
        return at;
      }
      Status status = scan_line(input.substr(end, next - end), draft);
      if (!status.ok()) {
        return status;
      }
      ++line_;
      end = next;
    } while (in_facet_);
    at = end;
  }
  return at;
}

Status TextStlScanner::scan_line(std::string_view line, Draft& draft) {
  std::size_t at = 0;
  const std::string_view word = next_word(line, at);
  const std::string keyword = lower(word);
  if (!in_facet_ && keyword == "facet") {
    return scan_facet_line(line, at, draft);
  }
  if (in_facet_ && keyword == "vertex") {
    return scan_vertex(line, at, draft);
  }
  draft.keep(line);
  if (in_facet_ && keyword == "endfacet") {
    return end_facet();
  }
  const bool known =
      in_facet_ ? keyword == "outer" || keyword == "endloop" : keyword == "solid" || keyword == "endsolid";
  if (known || keyword.empty()) {
    return {};
  }
  return failure({"found ", quoted(word), "; expected ",
                  (in_facet_ ? "outer loop, vertex, endloop or endfacet" : "solid, facet or endsolid")});
}

/// The old normal's numbers are not read: some writers put nan there.
Status TextStlScanner::scan_facet_line(std::string_view line, std::size_t at, Draft& draft) {
  in_facet_ = true;
  corners_ = 0;
  const std::string_view normal = next_word(line, at);
  if (lower(normal) != "normal") {
    return failure({"found ", quoted(normal), "; expected normal"});
  }
  std::size_t kept = 0;
  for (int component = 0; component < 3; ++component) {
    const std::string_view word = next_word(line, at);
    if (word.empty()) {
      return failure({"expected 3 numbers of a normal"});
    }
    draft.keep(line.substr(kept, at - word.size() - kept));
    draft.facet_normal(component);
    kept = at;
  }
  draft.keep(line.substr(kept));
  return {};
}

Status TextStlScanner::scan_vertex(std::string_view line, std::size_t at, Draft& draft) {
  std::size_t kept = 0;
  ++corners_;
  Status status = take_point(line, kept, at, draft);
  draft.keep(line.substr(kept));
  return status;
}

Status TextStlScanner::end_facet() {
  in_facet_ = false;
  if (corners_ != 3) {
    return failure({"facet has ", corners_, " vertices; expected 3"});
  }
  collect_facet(polygons_, vertices_, line_);
  return {};
}

class BinaryStlScanner final : public Scanner {
 public:
  explicit BinaryStlScanner(PolygonCollector* polygons) : polygons_(polygons) {}

  Result<std::size_t> scan(std::string_view input, bool last, Draft& draft) override;
  Status finish() override { return facets_ < count_ ? ends_early() : require_vertices(facets_); }
  std::string place() const override { return message({"byte ", offset_}); }

 private:
  Status scan_facet(std::string_view facet, Draft& draft);
  Status ends_early() const { return failure({"the file ends inside facet ", facets_ + 1, " of ", count_}); }

  PolygonCollector* polygons_;
  std::uint64_t offset_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t facets_ = 0;
};

Result<std::size_t> BinaryStlScanner::scan(std::string_view input, bool last, Draft& draft) {
  draft.set_style(NumberStyle::float_little);
  std::size_t at = 0;
  if (offset_ == 0) {
    if (input.size() < kHeaderSize) {
      if (!last) {
        return std::size_t{0};
      }
      return failure({"the file ends inside the header of a binary STL (", input.size(), " of 84 bytes)"});
    }
    count_ = load<std::uint32_t>(&input[80], false);
    draft.keep(input.substr(0, kHeaderSize));
    offset_ = at = kHeaderSize;
  }
  for (; facets_ < count_ && input.size() - at >= kFacetSize && !draft.full(); at += kFacetSize) {
    Status status = scan_facet(input.substr(at, kFacetSize), draft);
    if (!status.ok()) {
      return status;
    }
    offset_ += kFacetSize;
    ++facets_;
  }
  if (facets_ == count_) {  // what follows the facets stays
    draft.keep(input.substr(at));
    offset_ += input.size() - at;
    return input.size();
  }
  if (last && input.size() - at < kFacetSize) {
    return ends_early();
  }
  return at;
}

Status BinaryStlScanner::scan_facet(std::string_view facet, Draft& draft) {
  for (int component = 0; component < 3; ++component) {
    draft.facet_normal(component);
  }
  for (std::size_t i = 12; i < 48; i += 4) {
    const float value = load<float>(&facet[i], false);
    if (!std::isfinite(value)) {
      return failure({"vertex ", (i - 12) / 12 + 1, " of facet ", facets_ + 1, " is not finite"});
    }
    if (!draft.admits(static_cast<double>(value))) {
      return too_far(static_cast<double>(value), draft);
    }
    draft.coordinate(value);
  }
  draft.keep(facet.substr(48));
  collect_facet(polygons_, 3 * (std::uint64_t{facets_} + 1), offset_);
  return {};
}

/// Tells text from binary by the first bytes. Both may begin with "solid", but in a binary file a
/// zero byte follows soon: the padding of the name, the upper byte of the count, the attributes.
class StlScanner final : public Scanner {
 public:
  explicit StlScanner(PolygonCollector* polygons) : polygons_(polygons) {}

  Result<std::size_t> scan(std::string_view input, bool last, Draft& draft) override {
    constexpr std::size_t enough = 512;
    if (!actual_) {
      if (input.size() < enough && !last) {
        return std::size_t{0};
      }
      choose(input.substr(0, enough));
    }
    return actual_->scan(input, last, draft);
  }
  Status finish() override { return actual_ ? actual_->finish() : failure({"the file is empty"}); }
  std::string place() const override { return actual_ ? actual_->place() : "byte 0"; }

 private:
  void choose(std::string_view start) {
    if (start.find('\0') == kNpos) {
      actual_ = std::make_unique<TextStlScanner>(polygons_);
    } else {
      actual_ = std::make_unique<BinaryStlScanner>(polygons_);
    }
  }

  PolygonCollector* polygons_;
  std::unique_ptr<Scanner> actual_;
};

}  // namespace

std::unique_ptr<Scanner> make_stl_scanner(PolygonCollector* polygons) { return std::make_unique<StlScanner>(polygons); }

Status write_stl(std::span<const double> positions, std::span<const std::uint32_t> triangles, Bytes& out) {
  if (triangles.empty()) {
    return {ErrorCode::invalid_shape, "the shape has no faces; expected some, since STL holds nothing else"};
  }
  Draft facets({.soft_limit = 1 << 20});
  facets.set_style(NumberStyle::float_little);
  out.resize(out.size() + 80);
  store(out, static_cast<std::uint32_t>(triangles.size() / 3), false);
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (int component = 0; component < 3; ++component) {
      facets.facet_normal(component);
    }
    for (std::size_t corner = t; corner < t + 3; ++corner) {
      const double* position = &positions[3 * std::size_t{triangles[corner]}];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        facets.coordinate(position[axis]);
      }
    }
    facets.keep(std::string_view("\0\0", 2));
    if (!facets.full() && t + 3 < triangles.size()) {
      continue;
    }
    Status status = facets.emit(facets.points(), out);
    if (!status.ok()) {
      return status;
    }
    facets.clear();
  }
  return {};
}

}  // namespace pliant::io
