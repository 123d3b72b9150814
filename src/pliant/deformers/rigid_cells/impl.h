// What RigidCells is made of; only its own sources include this.
#pragma once

#include <memory>
#include <vector>

#include "pliant/deformers/rigid_cells/blend.h"
#include "pliant/deformers/rigid_cells/deformer.h"
#include "pliant/deformers/rigid_cells/holds.h"
#include "pliant/deformers/rigid_cells/smooth_map.h"
#include "pliant/deformers/rigid_cells/solver.h"
#include "pliant/deformers/rigid_cells/start.h"

namespace pliant {

struct RigidCells::Impl {
  RigidCellsOptions options;
  std::vector<double> point_factors;
  cells::CellTree tree;
  cells::CellModel model;
  std::vector<Index> cell_of_point;
  std::vector<std::vector<Index>> pieces;  ///< of the shape, that stay rigid
  std::vector<cells::CellMotion> motions;

  // -- While constraints stay.
  std::vector<cells::Rider> riders;
  cells::CellSolver solver;
  cells::CellStart start;
  bool begins = false;  ///< the next iteration begins where `start` says
  std::vector<cells::Hold> holds;
  int set_ups = 0;
  Index unknowns = 0;

  // -- Carrying the shape, made when first asked for.
  std::unique_ptr<cells::SmoothMap> map;
  cells::SmoothMap::Places places;
  std::vector<cells::Followed> followed;

  explicit Impl(cells::CellTree built) : tree(std::move(built)) {}

  /// The tree has changed: what follows from it.
  void take_tree(const Shape& shape);
  std::vector<cells::Hold> find_holds(const RigidCells& self) const;
  void prepare_map(const Shape& shape);
  Points carry_shape(const Shape& shape);
};

}  // namespace pliant
