#include "pliant/deformers/embedded_graph/start.h"

#include <algorithm>
#include <numeric>

#include "pliant/geometry/closest_rotation.h"

namespace pliant::embedded {
namespace {

/// Turns of handles below this (radians) need no prediction: an iteration or two follows them.
constexpr double kSmallTurn = 0.2;

}  // namespace

void GraphStart::set_up(const DeformationGraph& graph, const Influences& influences,
                        const std::vector<Handle>& handles) {
  const GraphEnergy& energy = solver_.energy();
  const std::vector<Index>& free_of_node = energy.free_of_node();
  length_unit_ = graph.length_unit;
  origin_ = graph.origin;
  nodes_ = graph.scaled(graph.nodes)(Eigen::all, energy.node_of_free());

  DisjointSets sets(energy.free_nodes());
  for (const auto& [j, k] : energy.free_edges()) sets.join(j, k);
  components_ = sets.numbered();
  anchored_.assign(components_.count, false);
  for (const auto& [a, b] : graph.edges) {
    const Index j = free_of_node[a], k = free_of_node[b];
    if ((j < 0) != (k < 0)) anchored_[components_.of[std::max(j, k)]] = true;
  }
  part_of_moved_.assign(influences.size(), -1);
  for (Index l = 0; l < influences.size(); ++l) {
    for (int s = 0; s < influences.k && part_of_moved_[l] < 0; ++s) {
      const Index node = influences.indices[static_cast<std::size_t>(l) * influences.k + s];
      if (free_of_node[node] >= 0) part_of_moved_[l] = components_.of[free_of_node[node]];
    }
  }
  grips_.clear();
  Index first = 0;
  for (const Handle& handle : handles) {
    grips_.emplace_back(handle.points.size());
    std::iota(grips_.back().begin(), grips_.back().end(), first);
    first += static_cast<Index>(handle.points.size());
  }
}

double GraphStart::small_turn() const { return kSmallTurn; }

Eigen::Vector3d GraphStart::standing(Index moved) const {
  return targets_.col(moved) + length_unit_ * solver_.gap(moved);
}

void GraphStart::turn_node(Vector& x, Index j, const Eigen::Matrix3d& rotation) const {
  const Eigen::Matrix3d u = solver_.energy().displacement_gradient(x, j);
  solver_.energy().set_displacement_gradient(x, j, rotation * u + (rotation - Eigen::Matrix3d::Identity()));
}

void GraphStart::try_rigid(const std::vector<PartMotion>& motions) {
  const GraphEnergy& energy = solver_.energy();
  Vector x = solver_.x();
  for (const auto& [part, motion] : motions) {
    // The same motion in the solver's frame.
    const Eigen::Vector3d shift = (motion.rotation * origin_ + motion.translation - origin_) / length_unit_;
    for (Index j = 0; j < energy.free_nodes(); ++j) {
      if (components_.of[j] != part) continue;
      const Eigen::Vector3d at = nodes_.col(j) + energy.translation(x, j);
      turn_node(x, j, motion.rotation);
      energy.set_translation(x, j, motion.rotation * at + shift - nodes_.col(j));
    }
  }
  solver_.start_at(x);
}

void GraphStart::try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) {
  // What spreads displacements over the graph spreads turns as well; translations follow by one
  // linear solve.
  const GraphEnergy& energy = solver_.energy();
  const Vector spread = solver_.spread(grips_, turns);
  Vector x = solver_.x();
  for (Index j = 0; j < energy.free_nodes(); ++j) turn_node(x, j, rotation_of(energy.translation(spread, j)));
  solver_.start_turned(x, in_any_case);
}

}  // namespace pliant::embedded
