// An order of a shape's points that its numbering and placement do not change.
#pragma once

#include <cstdint>
#include <vector>

#include "pliant/geometry/shape.h"

namespace pliant {

/// An order of the points of a shape that does not depend on how they are numbered, nor (where the
/// shape has no rotational symmetry) on how the scene is moved, turned or scaled: by distance from
/// the centroid, ties (within 1e-9 of the size) by the coordinates along the principal axes, whose
/// signs make the third moments positive and, where one of these vanishes, the frame right-handed.
/// Where the axes are not unique the input's axes serve: then only turning the scene changes the
/// order. Returns a permutation: order[rank] = point.
std::vector<Index> canonical_order(const Shape& shape);

/// The triangles over ranks instead of points: corners ascending, columns in lexicographic order,
/// so that they too depend on the shape alone. `order`: canonical_order of the shape.
Triangles canonical_triangles(const Shape& shape, const std::vector<Index>& order);

/// `value` rounded to 30 significant bits (1e-9 relative): quantities that differ by rounding alone
/// compare equal, so that a tie is decided by rank and not by the order of a summation. For values
/// without a unit: in another unit they round elsewhere.
inline double without_rounding_noise(double value) {
  // Eigen's bit_cast: the standard one is missing from our WASM toolchain.
  constexpr std::uint64_t dropped = 52 - 30;
  const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
  const std::uint64_t bits = Eigen::numext::bit_cast<std::uint64_t>(value) + half;
  return Eigen::numext::bit_cast<double>(bits >> dropped << dropped);
}

}  // namespace pliant
