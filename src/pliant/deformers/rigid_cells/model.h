// What the cells of a shape are at rest, as solving sees them.
#pragma once

#include <array>
#include <vector>

#include "pliant/deformers/rigid_cells/cell_tree.h"
#include "pliant/deformers/rigid_cells/energy.h"

namespace pliant::cells {

/// Places about the scene's `origin`, so that numbers stay small.
struct CellModel {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Points centers;  ///< of the cells, about the origin
  std::vector<double> sides;
  std::vector<Eigen::Vector3i> corners;     ///< of the cells, in units of the smallest
  std::vector<double> factors;              ///< stiffness
  std::vector<std::array<Index, 2>> pairs;  ///< sorted
  std::vector<double> weights;              ///< of the pairs, with stiffness
  std::vector<Glue> glue;                   ///< of the pairs

  Index size() const { return static_cast<Index>(sides.size()); }
  /// All cells at rest.
  std::vector<CellMotion> rest() const;
  double energy(const std::vector<CellMotion>& motions) const;
  /// How much each cell differs from its neighbours: root of its share of the pairs' energy over their
  /// weights, in parts of its side. Nothing where a body moves as one.
  std::vector<double> strains(const std::vector<CellMotion>& motions) const;
  /// Cells that hang together, numbered.
  std::vector<Index> parts() const;
};

/// Motions of cells that were split or joined: where those they were before took them.
std::vector<CellMotion> inherited_motions(const CellModel& before, const std::vector<CellMotion>& motions,
                                          const CellModel& after, const CellTree::Origins& origins);

/// point_factors: stiffness of each point of the shape.
CellModel cell_model(const CellTree& tree, const Shape& shape, const std::vector<double>& point_factors);

/// Stiffness of each point of the shape; 1 where no region holds it.
std::vector<double> point_factors(const Shape& shape, const std::vector<CellStiffness>& regions);

}  // namespace pliant::cells
