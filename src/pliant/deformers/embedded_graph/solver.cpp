#include "pliant/deformers/embedded_graph/solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "pliant/deformers/embedded_graph/barrier.h"
#include "pliant/geometry/closest_rotation.h"

namespace pliant::embedded {
namespace {

/// On the diagonal of every system: a component without a handle floats, and a path graph leaves
/// the twist about its segments free. Small against entries of about 10 to 1000.
constexpr double kDamping = 1e-6;
/// What E_rot adds to the metric on the entries of R, times w_rot: between its curvature for a turn
/// (none) and for a stretch (4).
constexpr double kRotationMetric = 2.0;
/// In exact mode the constraints are stiffer by this factor. Multipliers alone would take as many
/// rounds as the graph is stiffer than a handle's grip on the nodes that move few of its points a
/// little. It costs no iterations: E_con is quadratic, and the metric knows it.
constexpr double kExactStiffness = 1e7;
/// What it adds to kDamping: rounding beside such entries must not make a pivot negative.
constexpr double kExactDamping = 1e-3;
/// Exact targets are met to the caller's tolerance, and to this, in parts of the graph's size.
constexpr double kExactReach = 2e-6;
/// A start with a node below this is mended: the barrier needs one inside.
constexpr double kLeastDeterminant = 1e-3;
/// Steps that promise to lower the energy by less than this part of it are rounding.
constexpr double kRounding = 1e-13;
/// Turns of the constraints below this (radians) need no prediction.
constexpr double kSmallTurn = 0.2;
/// So many points of a handle, evenly picked, tell its turn well enough for a prediction.
constexpr std::size_t kEnoughForTurn = 250;

double largest(const Vector& v) { return v.lpNorm<Eigen::Infinity>(); }

}  // namespace

Status GraphSolver::set_up(const DeformationGraph& graph, const std::vector<bool>& frozen, Points constrained,
                           const Influences& influences, const SolverOptions& options, const Pose& pose) {
  options_ = options;
  Weights weights = options.weights;
  if (options.exact) weights.constraint *= kExactStiffness;
  constrained_ = std::move(constrained);
  displacement_ = Points::Zero(3, constrained_.cols());
  shift_ = displacement_;
  energy_.set_up(graph, frozen, constrained_, influences, weights);
  const Points g = graph.scaled(graph.nodes);
  nodes_ = g(Eigen::all, energy_.node_of_free());
  extent_ = graph.size() > 0 ? (g.rowwise().maxCoeff() - g.rowwise().minCoeff()).norm() : 0.0;
  find_components(graph, influences);

  x_.resize(3 * energy_.rows());
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) energy_.entry(x_, a, j)[c] = pose(4 * a + c, energy_.node_of_free()[j]);
    }
  }
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    // A pose from elsewhere may hold reflections.
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + energy_.displacement_gradient(x_, j);
    if (r.determinant() < kLeastDeterminant) {
      set_displacement_gradient(j, closest_rotation(r) - Eigen::Matrix3d::Identity());
    }
  }
  for (Vector* v : {&gradient_, &direction_, &previous_, &step_, &change_}) v->setZero(x_.size());
  memory_.reset(x_.size());
  if (energy_.free_nodes() == 0) return {};
  return factorize_metric(graph);
}

void GraphSolver::find_components(const DeformationGraph& graph, const Influences& influences) {
  DisjointSets sets(energy_.free_nodes());
  for (const auto& [j, k] : energy_.free_edges()) sets.join(j, k);
  components_ = sets.numbered();
  const std::vector<Index>& free_of_node = energy_.free_of_node();
  anchored_.assign(components_.count, false);
  for (const auto& [a, b] : graph.edges) {
    const Index j = free_of_node[a], k = free_of_node[b];
    if ((j < 0) != (k < 0)) anchored_[components_.of[std::max(j, k)]] = true;
  }
  constraint_component_.assign(constrained_.cols(), -1);
  for (Index l = 0; l < constrained_.cols(); ++l) {
    for (int s = 0; s < influences.k && constraint_component_[l] < 0; ++s) {
      const Index node = influences.indices[static_cast<std::size_t>(l) * influences.k + s];
      if (free_of_node[node] >= 0) constraint_component_[l] = components_.of[free_of_node[node]];
    }
  }
}

double GraphSolver::damping() const { return options_.exact ? kDamping + kExactDamping : kDamping; }

Status GraphSolver::factorize_metric(const DeformationGraph& graph) {
  std::vector<Index> order;
  for (Index node : graph.elimination_order) {
    const Index j = energy_.free_of_node()[node];
    if (j >= 0) order.push_back(j);
  }
  const bool newton = options_.kind == EmbeddedGraphSolver::gauss_newton;
  BlockMatrix metric;
  energy_.constant_matrix(metric);
  if (newton) constant_ = metric;
  for (Index j = 0; j < metric.nodes; ++j) {
    Eigen::Map<Eigen::Matrix4d> block(metric.diagonal_block(j));
    block.diagonal().head<3>().array() += kRotationMetric * options_.weights.rotation;
    block(3, 3) += damping();
  }
  if (Status s = metric_factor_.analyze(metric, order); !s.ok()) return s;
  if (Status s = metric_factor_.factorize(metric); !s.ok()) return s;
  ++analyses_;
  if (!newton) {
    ++factorizations_;
    return {};
  }
  energy_.gauss_newton_matrix(x_, constant_, newton_);
  return newton_factor_.analyze_like(metric_factor_, newton_);
}

void GraphSolver::set_targets(const Points& targets, const std::vector<Turn>& turns) {
  displacement_ = targets - constrained_;
  shift_.setZero();
  last_violation_ = 0.0;
  energy_.constraints().set_targets(displacement_);
  evaluate();
  if (energy_.free_nodes() == 0) return;
  const bool beyond_half_turn =
      std::any_of(turns.begin(), turns.end(), [](const Turn& t) { return t.rotation.norm() > std::numbers::pi; });
  if (!beyond_half_turn) predict_rigid();
  predict_turns(turns, beyond_half_turn);
  update_gradient();
}

bool GraphSolver::keep_if_lower(double previous_total) {
  if (total() < previous_total) {
    memory_.clear();
    return true;
  }
  x_ = previous_;
  evaluate();
  return false;
}

RigidMotion GraphSolver::motion_of(const std::vector<Index>& constraints, std::size_t most) const {
  RigidFit fit;
  const std::size_t stride = std::max<std::size_t>(1, constraints.size() / most);
  for (std::size_t i = 0; i < constraints.size(); i += stride) {
    const Index l = constraints[i];
    const Eigen::Vector3d wanted = constrained_.col(l) + displacement_.col(l);
    fit.add(wanted + shift_.col(l) + energy_.constraints().evaluated().col(l), wanted);
  }
  return fit.motion();
}

void GraphSolver::predict_rigid() {
  // A component that nothing holds follows the best rigid motion of its handles at no cost.
  std::vector<std::vector<Index>> floating(components_.count);  // constraints of components that float
  for (Index l = 0; l < constrained_.cols(); ++l) {
    const Index c = constraint_component_[l];
    if (c >= 0 && !anchored_[c]) floating[c].push_back(l);
  }
  if (std::all_of(floating.begin(), floating.end(), [](const auto& f) { return f.empty(); })) return;
  previous_ = x_;
  const double before = total();
  for (Index c = 0; c < components_.count; ++c) {
    const std::vector<Index>& members = floating[c];
    if (members.empty()) continue;
    const RigidMotion motion = motion_of(members, members.size());
    for (Index j = 0; j < energy_.free_nodes(); ++j) {
      if (components_.of[j] != c) continue;
      const Eigen::Vector3d at = nodes_.col(j) + energy_.translation(x_, j);
      const Eigen::Vector3d shift = motion.rotation * at + motion.translation - nodes_.col(j);
      turn_node(j, motion.rotation);
      for (int a = 0; a < 3; ++a) energy_.entry(x_, a, j)[3] = shift[a];
    }
  }
  evaluate();
  keep_if_lower(before);
}

void GraphSolver::turn_node(Index j, const Eigen::Matrix3d& rotation) {
  // U' = Q (I + U) - I, in displacements.
  const Eigen::Matrix3d u = energy_.displacement_gradient(x_, j);
  set_displacement_gradient(j, rotation * u + (rotation - Eigen::Matrix3d::Identity()));
}

void GraphSolver::set_displacement_gradient(Index j, const Eigen::Matrix3d& u) {
  for (int a = 0; a < 3; ++a) {
    for (int c = 0; c < 3; ++c) energy_.entry(x_, a, j)[c] = u(a, c);
  }
}

void GraphSolver::predict_turns(const std::vector<Turn>& turns, bool as_told) {
  // The turns of the handles, spread over the graph as smoothly as its Laplacian can, give every
  // node a rotation to start from; translations follow by one linear solve.
  std::vector<Eigen::Vector3d> rotations;
  double largest = 0.0;
  for (const Turn& turn : turns) {
    // Where no turn is told beyond what the points show, the points know better: the shape may lag.
    rotations.push_back(as_told ? turn.rotation
                                : rotation_vector_of(motion_of(turn.constraints, kEnoughForTurn).rotation));
    largest = std::max(largest, rotations.back().norm());
  }
  if (largest < kSmallTurn) return;

  // What spreads displacements over the graph spreads turns as well.
  previous_ = x_;
  const double before = total();
  direction_.setZero();
  for (std::size_t t = 0; t < turns.size(); ++t)
    energy_.constraints().add_common(turns[t].constraints, rotations[t], direction_);
  direction_ *= options_.weights.constraint;
  metric_factor_.solve(direction_.data(), 3);
  for (Index j = 0; j < energy_.free_nodes(); ++j) turn_node(j, rotation_of(energy_.translation(direction_, j)));
  direction_ = x_ - previous_;
  energy_.along(previous_, direction_);
  energy_.advance(1.0, x_);  // turns keep determinants, and with them the barrier
  update_gradient();
  follow_metric();
  if (as_told) {
    // Targets alone cannot tell a turn from the same turn short of a full one: take it as told.
    memory_.clear();
  } else {
    keep_if_lower(before);
  }
}

void GraphSolver::follow_metric() {
  memory_.clear();
  direction_ = -gradient_;
  metric_factor_.solve(direction_.data(), 3);
  const barrier::Fall fall = search_line();
  x_ += fall.alpha * direction_;
  energy_.advance(fall.alpha, x_);
  barrier_ = fall.barrier;
}

Status GraphSolver::find_direction() {
  if (options_.kind == EmbeddedGraphSolver::automatic) {
    memory_.direction(
        gradient_, [this](Vector& d) { metric_factor_.solve(d.data(), 3); }, direction_);
    return {};
  }
  energy_.gauss_newton_matrix(x_, constant_, newton_);
  for (Index j = 0; j < newton_.nodes; ++j) {
    Eigen::Map<Eigen::Matrix<double, 12, 12>>(newton_.diagonal_block(j)).diagonal().array() += damping();
  }
  barrier::add_half_curvature(energy_, x_, newton_);
  ++factorizations_;
  if (Status s = newton_factor_.factorize(newton_); !s.ok()) return s;
  for (Index j = 0; j < newton_.nodes; ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) change_[12 * j + 4 * a + c] = -energy_.entry(gradient_, a, j)[c];
    }
  }
  newton_factor_.solve(change_.data(), 1);
  for (Index j = 0; j < newton_.nodes; ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) energy_.entry(direction_, a, j)[c] = change_[12 * j + 4 * a + c];
    }
  }
  return {};
}

void GraphSolver::evaluate() {
  energy_.evaluate(x_);
  barrier_ = barrier::sum(energy_, x_);
}

void GraphSolver::update_gradient() {
  energy_.half_gradient(x_, gradient_);
  if (barrier_ > 0.0) barrier::add_half_gradient(energy_, x_, gradient_);
}

barrier::Fall GraphSolver::search_line() {
  return barrier::first_minimum(energy_, energy_.along(x_, direction_), 2.0 * slope(), x_, direction_, along_);
}

Result<GraphSolver::Outcome> GraphSolver::step(double tolerance) {
  if (energy_.free_nodes() == 0) return Outcome{false, true};
  const Terms terms_before = energy_.terms();
  const double before = total(), barrier_before = barrier_;
  if (Status s = find_direction(); !s.ok()) return s;
  if (!(slope() < 0.0) && !memory_.empty()) {
    memory_.clear();
    if (Status s = find_direction(); !s.ok()) return s;
  }
  const barrier::Fall fall = search_line();
  previous_ = x_;
  step_ = fall.alpha * direction_;
  x_ += step_;
  energy_.advance(fall.alpha, x_);
  barrier_ = fall.barrier;
  if (!(fall.alpha > 0.0) || !(total() < before)) {
    x_ = previous_;
    energy_.retreat(fall.alpha, terms_before);
    barrier_ = barrier_before;
    if (memory_.empty()) {
      const bool rounding = -slope() < kRounding * (1.0 + total());
      return Outcome{false, (rounding || gradient_gone(tolerance)) && !tighten(tolerance)};
    }
    memory_.clear();  // once more along the plain direction before giving up
    return step(tolerance);
  }
  change_ = gradient_;
  update_gradient();
  change_ = gradient_ - change_;
  memory_.remember(step_, change_);

  // Eq. 12: change of the energy, gradient and step are all small.
  const double f = total();
  const bool small = before - f < tolerance * (1.0 + f) && gradient_gone(tolerance) &&
                     largest(step_) < std::sqrt(tolerance) * (1.0 + largest(step_));
  return Outcome{true, small && !tighten(tolerance)};
}

bool GraphSolver::gradient_gone(double tolerance) const {
  return 2.0 * largest(gradient_) < std::cbrt(tolerance) * (1.0 + total());
}

bool GraphSolver::tighten(double tolerance) {
  // Method of multipliers: what is missing from a target is added to it. True while that helps.
  if (!options_.exact || displacement_.cols() == 0) return false;
  const double violation = (energy_.constraints().residuals(x_) + shift_).colwise().norm().maxCoeff();
  const bool met = violation <= std::min(tolerance, kExactReach) * extent_;
  const bool stuck = last_violation_ > 0.0 && violation > 0.5 * last_violation_;
  if (met || stuck) return false;
  last_violation_ = violation;
  shift_ = -energy_.constraints().residuals(x_);
  energy_.constraints().set_targets(displacement_ + shift_);
  evaluate();
  update_gradient();
  return true;
}

Terms GraphSolver::terms() const {
  Terms terms = energy_.terms();
  terms.barrier = barrier_;
  if (options_.exact) terms.constraint = (energy_.constraints().residuals(x_) + shift_).squaredNorm();
  return terms;
}

void GraphSolver::store(Pose& pose) const {
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) pose(4 * a + c, energy_.node_of_free()[j]) = energy_.entry(x_, a, j)[c];
    }
  }
}

}  // namespace pliant::embedded
