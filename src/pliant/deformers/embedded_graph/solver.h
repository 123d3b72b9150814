// Minimises the energy of a deformation graph, one step at a time.
//
// The reference is the paper's Gauss-Newton (eq. 10-11), damped. The fast way uses that E_reg and
// E_con are constant quadratics, alike for x, y and z: their matrix of 4 x 4 blocks is factorised
// once a grab and serves as the metric of a quasi-Newton method on the same, exact energy. Both
// minimise it together with the barrier that keeps det R > 0 at every node, and take the minimum
// along their direction.
#pragma once

#include <vector>

#include "pliant/core/status.h"
#include "pliant/deformers/embedded_graph/barrier.h"
#include "pliant/deformers/embedded_graph/energy.h"
#include "pliant/deformers/embedded_graph/pose.h"
#include "pliant/linalg/dense_kernels.h"
#include "pliant/linalg/sparse_cholesky.h"
#include "pliant/solve/lbfgs.h"

namespace pliant::embedded {

struct SolverOptions {
  Weights weights;
  EmbeddedGraphSolver kind = EmbeddedGraphSolver::automatic;
  bool exact = false;  ///< meet the targets exactly where the graph can
};

class GraphSolver {
 public:
  /// A new set of constraints: columns of `constrained` (scaled rest positions) with their
  /// influences, and frozen nodes. pose: of all nodes.
  /// Factorises. Errors: too_large, not_solvable.
  Status set_up(const DeformationGraph& graph, const std::vector<bool>& frozen, Points constrained,
                const Influences& influences, const SolverOptions& options, const Pose& pose);

  /// Another pose of all nodes under the same constraints; `set_targets` has to follow.
  void set_pose(const Pose& pose);

  /// New targets (3 x c, scaled).
  void set_targets(const Points& targets);
  /// From the target of a constrained point to where it stands, scaled; after set_targets or a start.
  Eigen::Vector3d gap(Index constrained) const {
    return shift_.col(constrained) + energy_.constraints().evaluated().col(constrained);
  }

  // Other places to start from, taken where the energy (and the barrier) is lower.
  void start_at(const Vector& x);
  /// x differs from the present unknowns by turns of nodes about themselves. Goes one step along the
  /// metric from there.
  void start_turned(const Vector& x, bool in_any_case);
  /// Groups of constrained points that want to be displaced, spread over the graph by the metric.
  Vector spread(const std::vector<std::vector<Index>>& groups, const std::vector<Eigen::Vector3d>& displacements);

  struct Outcome {
    bool accepted = false;
    bool converged = false;
  };
  /// One iteration; eq. 12 with eps = tolerance decides `converged`. No allocation.
  Result<Outcome> step(double tolerance);

  const GraphEnergy& energy() const { return energy_; }
  /// Terms against the caller's targets.
  Terms terms() const;
  const Vector& x() const { return x_; }
  int factorizations() const { return factorizations_; }
  int analyses() const { return analyses_; }
  /// Writes the free nodes back.
  void store(Pose& pose) const;

 private:
  double damping() const;
  Status factorize_metric(const DeformationGraph& graph);
  /// One step along the metric's own direction, from an up-to-date gradient.
  void follow_metric();
  /// After x_ and the energy have moved on from previous_: goes back unless the energy fell.
  bool keep_if_lower(double previous_total);
  Status find_direction();
  /// Eq. 9 and the barrier: what is minimised.
  double total() const { return energy_.total() + options_.weights.rotation * barrier_; }
  /// What eq. 12 measures changes of energy and gradient by.
  double measured() const;
  /// Half its slope along direction_.
  double slope() const { return dense::dot(gradient_.data(), direction_.data(), x_.size()); }
  /// The second test of eq. 12, the barrier's part included.
  bool gradient_gone(double tolerance) const;
  void evaluate();
  void update_gradient();
  barrier::Fall search_line();
  /// How far constrained points could still move towards the caller's targets, at most; scaled.
  double closable_gap();
  /// Exact targets: whether there is another problem to solve before they are met.
  bool tighten(double tolerance);

  SolverOptions options_;
  GraphEnergy energy_;
  double extent_ = 0.0;  ///< scaled size of the graph
  Points constrained_;   ///< scaled rest positions
  Points displacement_;  ///< wanted, from rest
  Points shift_;         ///< of the targets, accumulated: multipliers of the exact constraints
  Vector shift_pull_;    ///< C' shift
  double last_gap_ = 0.0;

  Vector x_, gradient_, direction_, previous_, step_, change_;
  BlockMatrix constant_, newton_;
  SparseCholesky metric_factor_, newton_factor_;
  Lbfgs memory_;
  double barrier_ = 0.0;                          ///< its sum at x_
  std::vector<barrier::DeterminantAlong> along_;  ///< determinants along the step
  int factorizations_ = 0;
  int analyses_ = 0;
};

}  // namespace pliant::embedded
