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
/// In exact mode the constraints are stiffer by this factor, so that the multipliers settle at
/// once.
constexpr double kExactStiffness = 100.0;
/// A start with a node below this is mended: the barrier needs one inside.
constexpr double kLeastDeterminant = 1e-3;
/// Turns of the constraints below this (radians) need no prediction.
constexpr double kSmallTurn = 0.2;
/// So many points of a handle, evenly picked, tell its turn well enough for a prediction.
constexpr std::size_t kEnoughForTurn = 250;

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
    const Eigen::Matrix3d r = affine_part(j);
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
    block(3, 3) += kDamping;
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
  energy_.evaluate(x_);
  if (energy_.free_nodes() == 0) return;
  const bool beyond_half_turn =
      std::any_of(turns.begin(), turns.end(), [](const Turn& t) { return t.rotation.norm() > std::numbers::pi; });
  if (!beyond_half_turn) predict_rigid();
  predict_turns(turns, beyond_half_turn);
  update_gradient();
}

bool GraphSolver::keep_if_lower(double previous_total) {
  if (energy_.total() < previous_total && std::isfinite(barrier())) {
    memory_.clear();
    return true;
  }
  x_ = previous_;
  energy_.evaluate(x_);
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
  const double before = energy_.total();
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
  energy_.evaluate(x_);
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
  const double before = energy_.total();
  direction_.setZero();
  for (std::size_t t = 0; t < turns.size(); ++t)
    energy_.constraints().add_common(turns[t].constraints, rotations[t], direction_);
  direction_ *= options_.weights.constraint;
  metric_factor_.solve(direction_.data(), 3);
  for (Index j = 0; j < energy_.free_nodes(); ++j) turn_node(j, rotation_of(energy_.translation(direction_, j)));
  direction_ = x_ - previous_;
  energy_.along(previous_, direction_);
  energy_.advance(1.0, x_);
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
  const double alpha = choose_step(energy_.along(x_, direction_), 2.0 * slope());
  x_ += alpha * direction_;
  energy_.advance(alpha, x_);
}

Status GraphSolver::find_direction() {
  if (options_.kind == EmbeddedGraphSolver::automatic) {
    memory_.direction(
        gradient_, [this](Vector& d) { metric_factor_.solve(d.data(), 3); }, direction_);
    return {};
  }
  energy_.gauss_newton_matrix(x_, constant_, newton_);
  for (Index j = 0; j < newton_.nodes; ++j) {
    Eigen::Map<Eigen::Matrix<double, 12, 12>> block(newton_.diagonal_block(j));
    block.diagonal().array() += kDamping;
    const Eigen::Matrix3d r = affine_part(j);
    const double curvature = barrier::curvature(r.determinant());
    if (curvature == 0.0) continue;
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> g = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>::Zero();
    g.leftCols<3>() = cofactors(r);
    const Eigen::Map<const Eigen::Matrix<double, 12, 1>> gradient(g.data());
    block += 0.5 * options_.weights.rotation * curvature * gradient * gradient.transpose();
  }
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

double GraphSolver::barrier() const {
  double sum = 0.0;
  for (Index j = 0; j < energy_.free_nodes(); ++j) sum += barrier::value(affine_part(j).determinant());
  return options_.weights.rotation * sum;
}

void GraphSolver::update_gradient() {
  energy_.half_gradient(x_, gradient_);
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    const Eigen::Matrix3d r = affine_part(j);
    const double slope = barrier::slope(r.determinant());
    if (slope == 0.0) continue;
    const Eigen::Matrix3d g = 0.5 * options_.weights.rotation * slope * cofactors(r);
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) energy_.entry(gradient_, a, j)[c] += g(a, c);
    }
  }
}

double GraphSolver::choose_step(const Quartic& course, double slope) {
  // A node may lose four fifths of its determinant in a step; those near the barrier are listed.
  double alpha = course.first_minimum();
  double barrier_before = 0.0;
  near_barrier_.clear();
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    const barrier::DeterminantAlong along(affine_part(j), energy_.displacement_gradient(direction_, j));
    while (alpha > 0.0 && along.at(alpha) < 0.2 * std::min(1.0, along.at_start())) alpha *= 0.7;
    if (along.at_start() >= barrier::kSafeDeterminant && along.at(alpha) >= barrier::kSafeDeterminant) continue;
    near_barrier_.push_back(along);
    barrier_before += options_.weights.rotation * barrier::value(along.at_start());
  }
  // Away from the barrier the first minimum of the quartic is the exact line search. Near it the
  // sum of both must fall, and the energy must not rise.
  if (near_barrier_.empty()) return alpha;
  for (int halvings = 0; halvings < 40; ++halvings, alpha *= 0.5) {
    double barrier_after = 0.0;
    for (const auto& along : near_barrier_) {
      barrier_after += options_.weights.rotation * barrier::value(along.at(alpha));
    }
    const double energy_after = course.value(alpha);
    if (energy_after < course.c[0] &&
        energy_after + barrier_after < course.c[0] + barrier_before + 1e-4 * alpha * slope) {
      return alpha;
    }
  }
  return 0.0;
}

Result<GraphSolver::Outcome> GraphSolver::step(double tolerance) {
  if (energy_.free_nodes() == 0) return Outcome{false, true};
  const Terms terms_before = energy_.terms();
  const double before = energy_.total();
  if (Status s = find_direction(); !s.ok()) return s;
  if (!(slope() < 0.0) && !memory_.empty()) {
    memory_.clear();
    if (Status s = find_direction(); !s.ok()) return s;
  }
  const double alpha = choose_step(energy_.along(x_, direction_), 2.0 * slope());
  previous_ = x_;
  step_ = alpha * direction_;
  x_ += step_;
  energy_.advance(alpha, x_);
  if (!(alpha > 0.0) || !(energy_.total() < before)) {
    x_ = previous_;
    energy_.retreat(alpha, terms_before);
    if (memory_.empty()) return Outcome{false, !tighten()};
    memory_.clear();  // once more along the plain direction before giving up
    return step(tolerance);
  }
  change_ = gradient_;
  update_gradient();
  change_ = gradient_ - change_;
  memory_.remember(step_, change_);

  // Eq. 12: change of the energy, gradient (twice our half) and step are all small.
  const double f = energy_.total();
  const auto largest = [](const Vector& v) { return v.lpNorm<Eigen::Infinity>(); };
  const bool small = before - f < tolerance * (1.0 + f) &&
                     2.0 * largest(gradient_) < std::cbrt(tolerance) * (1.0 + f) &&
                     largest(step_) < std::sqrt(tolerance) * (1.0 + largest(step_));
  return Outcome{true, small && !tighten()};
}

bool GraphSolver::tighten() {
  // Method of multipliers: what is missing from a target is added to it. True while that helps.
  if (!options_.exact || displacement_.cols() == 0) return false;
  const double violation = (energy_.constraints().residuals(x_) + shift_).colwise().norm().maxCoeff();
  const bool met = violation <= 1e-10 * extent_;
  const bool stuck = last_violation_ > 0.0 && violation > 0.5 * last_violation_;
  if (met || stuck) return false;
  last_violation_ = violation;
  shift_ = -energy_.constraints().residuals(x_);
  energy_.constraints().set_targets(displacement_ + shift_);
  energy_.evaluate(x_);
  update_gradient();
  return true;
}

Terms GraphSolver::terms() const {
  Terms terms = energy_.terms();
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
