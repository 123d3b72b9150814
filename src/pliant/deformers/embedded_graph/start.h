// How a deformation graph is started anew (solve/prediction.h): nodes turn about themselves, parts
// of the graph that no frozen node holds move as a whole.
#pragma once

#include <vector>

#include "pliant/core/disjoint_sets.h"
#include "pliant/deformers/embedded_graph/solver.h"
#include "pliant/solve/prediction.h"

namespace pliant::embedded {

class GraphStart final : public Start {
 public:
  explicit GraphStart(GraphSolver& solver) : solver_(solver) {}

  /// After the solver was set up with the points of these handles and their influences.
  void set_up(const DeformationGraph& graph, const Influences& influences, const std::vector<Handle>& handles);
  /// 3 x c, in the input's unit, as the solver knows them in its own.
  void set_targets(Points targets) { targets_ = std::move(targets); }

  double small_turn() const override;
  Eigen::Vector3d standing(Index moved) const override;
  Index part_count() const override { return components_.count; }
  bool floats(Index part) const override { return !anchored_[part]; }
  Index part_of(Index moved) const override { return part_of_moved_[moved]; }
  void try_rigid(const std::vector<PartMotion>& motions) override;
  void try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) override;

 private:
  /// U' = Q (I + U) - I, in displacements.
  void turn_node(Vector& x, Index free_node, const Eigen::Matrix3d& rotation) const;

  GraphSolver& solver_;
  double length_unit_ = 1.0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Points nodes_;                           ///< scaled rest positions of the free nodes
  DisjointSets::Numbered components_;      ///< of the free nodes, in their graph
  std::vector<bool> anchored_;             ///< components that touch a frozen node
  std::vector<Index> part_of_moved_;       ///< component; -1: all its nodes are frozen
  std::vector<std::vector<Index>> grips_;  ///< of each handle: its columns of the moved points
  Points targets_;
};

}  // namespace pliant::embedded
