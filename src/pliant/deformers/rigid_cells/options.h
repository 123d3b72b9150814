// Options of rigid cells (contract, section 3).
#pragma once

#include <vector>

#include "pliant/core/named_values.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// How points follow the cells (Botsch 2007, section 6).
enum class CellTransfer {
  rbf,    ///< triharmonic radial basis functions: smooth
  blend,  ///< the four nearest cells, weighted by inverse distance
};

/// What constraints hold of the cells they touch (section 4).
enum class CellHold {
  cells,   ///< the whole cell follows
  points,  ///< one point of it, about which the cell is free to turn
};

/// A region that is softer or stiffer than the rest: the cells its vertices lie in, and interior
/// cells next to it.
struct CellStiffness {
  std::vector<Index> vertices;  ///< of the input
  double factor = 1.0;          ///< of the weights in eq. 2, above 0
};

struct RigidCellsOptions {
  int resolution = 16;      ///< cells along the longest side before refinement, 1 to 256
  bool align = true;        ///< grid along the shape's principal axes, not the world's
  int boundary_levels = 1;  ///< how often cells at the boundary are split, 0 to 4
  bool refine = false;      ///< split cells where neighbours differ much, while solving
  bool interior = true;     ///< false: a shell
  CellTransfer transfer = CellTransfer::rbf;
  CellHold hold = CellHold::cells;
  std::vector<CellStiffness> stiffness = {};  ///< a later region wins where two overlap

  /// Errors: invalid_option, naming the option, its value and what was expected.
  Status validate(const Shape& shape) const;
};

void exchange(NamedFields& fields, RigidCellsOptions& options);

}  // namespace pliant
