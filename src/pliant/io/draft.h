// A piece of a file with its coordinates taken out: what to keep, and the places to fill.
#pragma once

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

/// Filled by a scanner in the order of the file, then written out once with other coordinates.
class Draft {
 public:
  /// `soft_limit`: the bytes after which the draft calls itself full.
  explicit Draft(std::size_t soft_limit = std::numeric_limits<std::size_t>::max()) : soft_limit_(soft_limit) {}

  static constexpr std::size_t kLongestText = 24;  ///< -1.2345678901234567e-308

  void clear();
  /// The bytes a coordinate takes at most.
  std::size_t longest_number() const;
  void set_style(NumberStyle style) { style_ = style; }

  /// Bytes that pass through.
  void keep(std::string_view bytes) { append(kept_, bytes); }
  /// The place of the next coordinate, and its value in the file. Three make a point.
  void coordinate(double value);
  /// The place of one component (0 to 2) of the unit normal of the facet whose corners are the next
  /// three points.
  void facet_normal(int component);

  bool full() const { return kept_.size() + 16 * points_.size() > soft_limit_; }
  /// The coordinates found, 3 a point.
  const std::vector<double>& points() const { return points_; }

  /// A state to return to when a record turns out to be incomplete.
  struct Mark {
    std::size_t kept, places, points;
  };
  Mark mark() const { return {kept_.size(), places_.size(), points_.size()}; }
  void rewind(const Mark& mark);

  /// Appends the piece to `out` with these coordinates, as many as points().
  /// Errors: invalid_shape (another number of them, one not finite or too large for the style).
  Status emit(std::span<const double> coordinates, Bytes& out) const;

 private:
  /// A number that stands after the first `after` kept bytes: coordinate `source`, or, below zero,
  /// component ~source % 3 of the normal of the facet at point ~source / 3 * 3.
  struct Place {
    std::uint32_t after;
    std::int32_t source;
  };

  Status append_value(double value, Bytes& out) const;

  std::size_t soft_limit_;
  NumberStyle style_ = NumberStyle::text;
  Bytes kept_;
  std::vector<Place> places_;
  std::vector<double> points_;
};

}  // namespace pliant::io
