// Small parts that nothing joins to the rest, as the eyes in a head.
#pragma once

#include <vector>

#include "pliant/geometry/shape.h"

namespace pliant {

struct LoosePart {
  std::vector<Index> points;  ///< ascending
  /// Points of the large parts: the nearest to it at rest, and two rings around them; ascending.
  std::vector<Index> beside;
};

/// Beyond so many loose parts a shape is a heap of pieces.
inline constexpr std::size_t kMostLooseParts = 64;

/// Parts of a surface with fewer than a fifth of the points of the largest one, and a bounding box whose diagonal is
/// below 0.3 of the shape's; most points first. None in the plane, where few points are joined by triangles, and where
/// there are more than kMostLooseParts.
std::vector<LoosePart> loose_parts(const Shape& shape);

}  // namespace pliant
