// Streams a file of any size through in pieces, replacing its coordinates and keeping every other
// byte, in memory bounded by the size of a piece and of one record. What a format drops because it
// goes stale (normals), or has turned, stands in its header: obj.h, ply.h, off.h, stl.h.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/io/bytes.h"
#include "pliant/io/draft.h"
#include "pliant/io/format.h"
#include "pliant/io/scanner.h"

namespace pliant::io {

/// open, then push and emit in turn, one emit a push, until the push with `last`.
class Rewriter {
 public:
  /// A record (a line, a facet, a PLY record) may have this many bytes.
  static constexpr std::size_t kMaxRecord = std::size_t{16} << 20;

  /// Starts a file; what an earlier one left is forgotten. The options say which coordinates it may have, and whether
  /// normals are turned instead of left out; their limit does not hold.
  void open(FileFormat format, const DraftOptions& options = {});

  /// The next piece of the file, of any size; `last` when nothing follows it. Afterwards `points`
  /// holds the coordinates of the records that are complete by now.
  /// Errors: parse_error (line or byte, and the reason; the file is then given up),
  /// invalid_option (no file is open, or emit is missing before this push).
  Status push(ByteView piece, bool last);

  /// 3 coordinates a vertex, in the file's order: those found by the last push.
  const std::vector<double>& points() const { return draft_.points(); }
  /// As many normals, in the same order, or none: as the file has them, of any length.
  const std::vector<double>& normals() const { return draft_.normals(); }

  /// New coordinates and normals, as many as points() and normals(); appends to `out` what to write to the new file.
  /// Errors: invalid_shape (their number, or one that is not finite or does not fit the format),
  /// invalid_option (no push before it). After an error emit can be called again.
  Status emit(std::span<const double> coordinates, std::span<const double> normals, Bytes& out);
  Status emit(std::span<const double> coordinates, Bytes& out) { return emit(coordinates, {}, out); }

 private:
  enum class State { closed, pushing, emitting, emitting_last };

  Status scan(bool last);

  State state_ = State::closed;
  std::unique_ptr<Scanner> scanner_;
  Bytes pending_;  ///< the incomplete record at the end of the last piece
  Draft draft_;
};

}  // namespace pliant::io
