// Small pieces of a shape that stay rigid: leaves of a tree, buttons of a coat.
#pragma once

#include <vector>

#include "pliant/geometry/shape.h"

namespace pliant::cells {

/// Connected parts (through shared edges) of two points or more whose bounding box is no longer across
/// than `size`: of a soup they are what must not bend. None where the shape is in one part.
std::vector<std::vector<Index>> small_pieces(const Shape& shape, double size);

/// Moves a piece by the rigid motion closest to how its points were carried, among those that are
/// closest to where its held points were.
void keep_rigid(const std::vector<Index>& piece, const std::vector<bool>& held, const Points& rest, Points& carried);

}  // namespace pliant::cells
