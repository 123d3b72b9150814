// What RigidCells is made of; only its own sources include this.
#pragma once

#include <vector>

#include "pliant/deformers/rigid_cells/carrier.h"
#include "pliant/deformers/rigid_cells/deformer.h"
#include "pliant/deformers/rigid_cells/holds.h"
#include "pliant/deformers/rigid_cells/solver.h"
#include "pliant/deformers/rigid_cells/start.h"

namespace pliant {

struct RigidCells::Impl {
  RigidCellsOptions options;
  std::vector<double> point_factors;
  cells::CellTree tree;
  cells::CellModel model;
  std::vector<Index> cell_of_point;
  std::vector<cells::CellMotion> motions;

  // -- While constraints stay.
  std::vector<cells::Rider> riders;
  cells::CellSolver solver;
  cells::CellStart start;
  bool begins = false;      ///< the next iteration begins where `start` says
  Index cells_at_rest = 0;  ///< before any refinement
  bool may_join = false;    ///< targets have moved since cells were joined
  std::vector<cells::Hold> holds;
  int set_ups = 0;
  Index unknowns = 0;

  cells::Carrier carrier;

  explicit Impl(cells::CellTree built) : tree(std::move(built)) {}

  /// The tree has changed: what follows from it.
  void take_tree(const Shape& shape);
  /// The same of cells that were split or joined; motions are inherited.
  void take_cells(const Shape& shape, const cells::CellTree::Origins& origins);
  /// Those whose neighbours differ most, as far as there is room.
  std::vector<bool> cells_to_split() const;
  std::vector<cells::Hold> find_holds(const RigidCells& self) const;
  cells::MovedCells moved_cells() const { return {tree, model, motions}; }
};

}  // namespace pliant
