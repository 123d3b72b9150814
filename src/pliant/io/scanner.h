// What every format provides to the readers and to the rewriter: finding the coordinates of a file
// piece by piece. Internal to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "pliant/core/message.h"
#include "pliant/core/status.h"
#include "pliant/io/bytes.h"
#include "pliant/io/draft.h"
#include "pliant/io/format.h"
#include "pliant/io/polygon_mesh.h"

namespace pliant::io {

/// Goes through one file from front to back. Constructed with a collector it also reads polygons
/// and texture coordinates; without one it only checks what it needs to find coordinates.
class Scanner {
 public:
  virtual ~Scanner() = default;

  /// Takes whole records from the front of `input` until it is used up, the rest is an incomplete
  /// record, or the draft is full; returns the number of bytes taken. With `last` the input ends
  /// the file: an incomplete record is then an error, so that all is taken unless the draft is
  /// full. Errors: parse_error with the place.
  virtual Result<std::size_t> scan(std::string_view input, bool last, Draft& draft) = 0;

  /// To be called once, after the last byte was taken. Errors: parse_error.
  virtual Status finish() = 0;

  /// Where the next record starts: "line 12" or "byte 84".
  virtual std::string place() const = 0;

 protected:
  Status failure(Words reason) const { return {ErrorCode::parse_error, message({place(), ": ", message(reason)})}; }
  Status too_far(double coordinate, const Draft& draft) const {
    return failure({"coordinate ", coordinate, "; expected at most ", draft.options().largest, " in magnitude"});
  }
  static Status require_vertices(std::uint64_t count) {
    if (count > 0) {
      return {};
    }
    return {ErrorCode::parse_error, "the file has no vertices"};
  }
};

/// A scanner for a file of the format, from its first byte on. `polygons`, if any, outlives it.
std::unique_ptr<Scanner> make_scanner(FileFormat format, PolygonCollector* polygons);

std::unique_ptr<Scanner> make_obj_scanner(PolygonCollector* polygons);
std::unique_ptr<Scanner> make_ply_scanner(PolygonCollector* polygons);
std::unique_ptr<Scanner> make_off_scanner(PolygonCollector* polygons);
std::unique_ptr<Scanner> make_stl_scanner(PolygonCollector* polygons);
std::unique_ptr<Scanner> make_xyz_scanner();

}  // namespace pliant::io
