// pliant-io: RawDocument and RawRewriter of bindings/js/boundary/raw.ts.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <emscripten/bind.h>

#include "pliant/io/document.h"
#include "pliant/io/rewriter.h"
#include "scratch.h"
#include "status_value.h"

namespace pliant::bindings {
namespace {

using emscripten::val;

struct BytesValue {
  StatusValue status;
  val bytes = val::undefined();
};

struct FractionValue {
  StatusValue status;
  double fraction = 0.0;
};

struct FoundValue {
  StatusValue status;
  val points = val::undefined();
  val normals = val::undefined();
};

/// Keeps what a call returned a view of.
class BoundDocument {
 public:
  StatusValue begin(const std::string& format, Scratch& scratch) {
    const Result<io::FileFormat> known = io::format_from_name(format);
    return to_value(known.ok() ? document_.begin(*known, scratch.take_bytes()) : known.status());
  }
  FractionValue advance() {
    const Result<double> fraction = document_.advance();
    return {to_value(fraction.status()), fraction.ok() ? *fraction : 0.0};
  }
  StatusValue assign(const Scratch& scratch) {
    return to_value(document_.assign(scratch.doubles(), scratch.integers()));
  }
  StatusValue assign_texcoords(const Scratch& scratch) {
    return to_value(document_.assign_texcoords(scratch.doubles()));
  }
  StatusValue assign_colors(const Scratch& scratch) { return to_value(document_.assign_colors(scratch.bytes())); }
  BytesValue write(const std::string& format, const Scratch& scratch) {
    output_ = {};
    const Result<io::FileFormat> known = io::format_from_name(format);
    if (!known.ok()) return {to_value(known.status()), view_of(output_)};
    Result<io::Bytes> bytes = document_.write(*known, scratch.doubles());
    if (bytes.ok()) output_ = std::move(*bytes);
    return {to_value(bytes.status()), view_of(output_)};
  }

  val positions() const { return view_of(document_.mesh().positions); }
  val face_vertices() const { return view_of(document_.mesh().face_vertices); }
  val face_offsets() const { return view_of(document_.mesh().face_offsets); }
  val colors() const { return view_of(document_.mesh().colors); }
  val triangles() const { return view_of(document_.triangles()); }
  val corner_texcoords() {
    const io::PolygonMesh& mesh = document_.mesh();
    corner_texcoords_.clear();
    corner_texcoords_.reserve(2 * mesh.corner_texcoords.size());
    for (std::size_t corner = 0; corner < mesh.corner_texcoords.size(); ++corner) {
      const auto [u, v] = mesh.corner_texcoord(corner);
      corner_texcoords_.push_back(u);
      corner_texcoords_.push_back(v);
    }
    return view_of(corner_texcoords_);
  }

 private:
  io::Document document_;
  io::Bytes output_;
  std::vector<double> corner_texcoords_;
};

class BoundRewriter {
 public:
  StatusValue open(const std::string& format, double largest, bool normals) {
    const Result<io::FileFormat> known = io::format_from_name(format);
    if (known.ok()) rewriter_.open(*known, {.largest = largest, .normals = normals});
    return to_value(known.status());
  }
  FoundValue push(const Scratch& scratch, bool last) {
    const Status status = rewriter_.push(scratch.bytes(), last);
    return {to_value(status), view_of(rewriter_.points()), view_of(rewriter_.normals())};
  }
  BytesValue emit(const Scratch& scratch) {
    output_.clear();
    const std::span<const double> numbers(scratch.doubles());
    const std::size_t coordinates = std::min(numbers.size(), rewriter_.points().size());
    const Status status = rewriter_.emit(numbers.first(coordinates), numbers.subspan(coordinates), output_);
    return {to_value(status), view_of(output_)};
  }

 private:
  io::Rewriter rewriter_;
  io::Bytes output_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(pliant_io) {
  emscripten::value_object<BytesValue>("RawBytes")
      .field("status", &BytesValue::status)
      .field("bytes", &BytesValue::bytes);
  emscripten::value_object<FractionValue>("RawFraction")
      .field("status", &FractionValue::status)
      .field("fraction", &FractionValue::fraction);
  emscripten::value_object<FoundValue>("RawFound")
      .field("status", &FoundValue::status)
      .field("points", &FoundValue::points)
      .field("normals", &FoundValue::normals);

  emscripten::class_<BoundDocument>("Document")
      .constructor<>()
      .function("begin", &BoundDocument::begin)
      .function("advance", &BoundDocument::advance)
      .function("positions", &BoundDocument::positions)
      .function("faceVertices", &BoundDocument::face_vertices)
      .function("faceOffsets", &BoundDocument::face_offsets)
      .function("triangles", &BoundDocument::triangles)
      .function("cornerTexcoords", &BoundDocument::corner_texcoords)
      .function("colors", &BoundDocument::colors)
      .function("assign", &BoundDocument::assign)
      .function("assignTexcoords", &BoundDocument::assign_texcoords)
      .function("assignColors", &BoundDocument::assign_colors)
      .function("write", &BoundDocument::write);

  emscripten::class_<BoundRewriter>("Rewriter")
      .constructor<>()
      .function("open", &BoundRewriter::open)
      .function("push", &BoundRewriter::push)
      .function("emit", &BoundRewriter::emit);
}

}  // namespace pliant::bindings
