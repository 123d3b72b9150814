// Small pieces of a shape that stay rigid: leaves of a tree, buttons of a coat.
#pragma once

#include <vector>

#include "pliant/geometry/shape.h"

namespace pliant::cells {

/// Connected parts (through shared edges) of two points or more whose bounding box is no longer across
/// than `size`: of a soup they are what must not bend. None where the shape is in one part.
std::vector<std::vector<Index>> small_pieces(const Shape& shape, double size);

/// Moves each piece by the rigid motion closest to how its points were carried.
void keep_rigid(const std::vector<std::vector<Index>>& pieces, const Points& rest, Points& carried);

}  // namespace pliant::cells
