// A piece of a file with its coordinates taken out: what to keep, and the places to fill.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/io/bytes.h"

namespace pliant::io {

/// How a file writes its coordinates.
enum class NumberStyle { text, double_little, double_big, float_little };

/// What a draft takes of a file.
struct DraftOptions {
  /// The bytes after which the draft calls itself full.
  std::size_t soft_limit = std::numeric_limits<std::size_t>::max();
  /// A coordinate of a larger magnitude is an error of the file.
  double largest = std::numeric_limits<double>::max();
  /// Vertices' normals are places to fill, where the format says which vertex each belongs to (PLY); else they are left
  /// out of the new file.
  bool normals = false;
};

/// Filled by a scanner in the order of the file, then written out once with other coordinates.
class Draft {
 public:
  explicit Draft(const DraftOptions& options = {}) : options_(options) {}

  static constexpr std::size_t kLongestText = 24;  ///< -1.2345678901234567e-308

  void clear();
  /// The bytes a coordinate takes at most.
  std::size_t longest_number() const;
  void set_style(NumberStyle style) { style_ = style; }

  /// Bytes that pass through.
  void keep(std::string_view bytes) { kept_.append(bytes); }
  /// The place of the next coordinate, and its value in the file. Three make a point.
  void coordinate(double value);
  /// The same where those of a point stand in any order: the place of number `source` of all coordinates, one of the
  /// last point's.
  void coordinate(std::size_t source, double value);
  /// The place of one component (0 to 2) of the unit normal of the facet whose corners are the next
  /// three points.
  void facet_normal(int component);
  /// The place of number `source` of the normals, one of those of the last point, and its value, or zero where that is
  /// not finite. `single`: a binary file has it in 32 bits.
  void normal(std::size_t source, double value, bool single);

  const DraftOptions& options() const { return options_; }
  bool admits(double coordinate) const { return std::abs(coordinate) <= options_.largest; }

  bool full() const { return kept_.size() + 16 * (points_.size() + normals_.size()) > options_.soft_limit; }
  /// The coordinates found, 3 a point.
  const std::vector<double>& points() const { return points_; }
  /// The normals found, one a point; none where they are no places to fill.
  const std::vector<double>& normals() const { return normals_; }

  /// A state to return to when a record turns out to be incomplete.
  struct Mark {
    std::size_t kept, places, points, normals;
  };
  Mark mark() const { return {kept_.size(), places_.size(), points_.size(), normals_.size()}; }
  void rewind(const Mark& mark);

  /// Appends the piece to `out` with these coordinates, as many as points(), and these normals, as many as normals().
  /// Errors: invalid_shape (another number of them, one not finite or too large for the style).
  Status emit(std::span<const double> coordinates, std::span<const double> normals, Bytes& out);
  Status emit(std::span<const double> coordinates, Bytes& out) { return emit(coordinates, {}, out); }

 private:
  /// What stands at a place: number `source` of the coordinates or of the normals, or of the unit normals of facets,
  /// which have three points each.
  enum class Kind : std::uint8_t { coordinate, facet_normal, normal, single_normal };
  struct Place {
    std::uint32_t after;  ///< kept bytes before it
    std::uint32_t source;
    Kind kind;
  };

  void add(Kind kind, std::size_t source);
  /// Writes a number at `to`, which has room for the longest; returns where it ends, or null where it does not fit.
  std::uint8_t* write(double value, Kind kind, std::uint8_t* to) const;

  DraftOptions options_;
  NumberStyle style_ = NumberStyle::text;
  ByteBuffer kept_;
  ByteBuffer written_;
  std::vector<Place> places_;
  std::vector<double> points_;
  std::vector<double> normals_;
};

}  // namespace pliant::io
