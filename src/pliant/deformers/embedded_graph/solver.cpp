#include "pliant/deformers/embedded_graph/solver.h"

#include <algorithm>
#include <cmath>

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
  extent_ = graph.size() > 0 ? (g.rowwise().maxCoeff() - g.rowwise().minCoeff()).norm() : 0.0;

  x_.resize(3 * energy_.rows());
  for (Vector* v : {&gradient_, &direction_, &previous_, &step_, &change_}) v->setZero(x_.size());
  memory_.reset(x_.size());
  set_pose(pose);
  if (energy_.free_nodes() == 0) return {};
  return factorize_metric(graph);
}

void GraphSolver::set_pose(const Pose& pose) {
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) energy_.entry(x_, a, j)[c] = pose(4 * a + c, energy_.node_of_free()[j]);
    }
  }
  for (Index j = 0; j < energy_.free_nodes(); ++j) {
    // A pose from elsewhere may hold reflections.
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + energy_.displacement_gradient(x_, j);
    if (r.determinant() < kLeastDeterminant) {
      energy_.set_displacement_gradient(x_, j, closest_rotation(r) - Eigen::Matrix3d::Identity());
    }
  }
  memory_.clear();
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

void GraphSolver::set_targets(const Points& targets) {
  displacement_ = targets - constrained_;
  shift_.setZero();
  shift_pull_.setZero(x_.size());
  last_gap_ = 0.0;
  energy_.constraints().set_targets(displacement_);
  evaluate();
  update_gradient();
}

bool GraphSolver::keep_if_lower(double previous_total) {
  const bool lower = total() < previous_total;
  if (lower) {
    memory_.clear();
  } else {
    x_ = previous_;
    evaluate();
  }
  update_gradient();
  return lower;
}

void GraphSolver::start_at(const Vector& x) {
  const double before = total();
  previous_ = x_;
  x_ = x;
  evaluate();
  keep_if_lower(before);
}

Vector GraphSolver::spread(const std::vector<std::vector<Index>>& groups,
                           const std::vector<Eigen::Vector3d>& displacements) {
  Vector spread = Vector::Zero(x_.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    energy_.constraints().add_common(groups[g], displacements[g], spread);
  }
  spread *= energy_.weights().constraint;
  if (spread.size() > 0) metric_factor_.solve(spread.data(), 3);
  return spread;
}

void GraphSolver::start_turned(const Vector& x, bool in_any_case) {
  if (energy_.free_nodes() == 0) return;
  const double before = total();
  previous_ = x_;
  direction_ = x - x_;
  energy_.along(x_, direction_);
  x_ = x;
  energy_.advance(1.0, x_);  // turns keep determinants, and with them the barrier
  update_gradient();
  follow_metric();
  if (!in_any_case) {
    keep_if_lower(before);
    return;
  }
  // Targets alone cannot tell a turn from the same turn short of a full one: take it as told.
  memory_.clear();
  update_gradient();
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
      if (!rounding && !gradient_gone(tolerance)) return Outcome{false, false};
      if (!tighten(tolerance)) return Outcome{false, true};
      return step(tolerance);  // towards other targets there is more to go
    }
    memory_.clear();  // once more along the plain direction before giving up
    return step(tolerance);
  }
  change_ = gradient_;
  update_gradient();
  change_ = gradient_ - change_;
  memory_.remember(step_, change_);

  // Eq. 12: change of the energy, gradient and step are all small.
  const bool small = before - total() < tolerance * (1.0 + measured()) && gradient_gone(tolerance) &&
                     largest(step_) < std::sqrt(tolerance) * (1.0 + largest(step_));
  return Outcome{true, small && !tighten(tolerance)};
}

bool GraphSolver::gradient_gone(double tolerance) const {
  return 2.0 * largest(gradient_) < std::cbrt(tolerance) * (1.0 + measured());
}

double GraphSolver::measured() const {
  // Where exact targets contradict each other the stiffened constraints outweigh all else, and nothing moves them.
  return options_.exact ? total() - energy_.weights().constraint * energy_.terms().constraint : total();
}

double GraphSolver::closable_gap() {
  // One step of the metric towards the targets alone: what the graph cannot follow, as where targets contradict each
  // other, is at right angles to all its motions and does not count.
  GraphConstraints& constraints = energy_.constraints();
  change_ = energy_.weights().constraint * (constraints.gradient() + shift_pull_);
  metric_factor_.solve(change_.data(), 3);
  return (constraints.residuals(change_) + displacement_ + shift_).colwise().norm().maxCoeff();
}

bool GraphSolver::tighten(double tolerance) {
  // Method of multipliers: what is missing from a target is added to it. True while that helps.
  if (!options_.exact || displacement_.cols() == 0) return false;
  const double gap = closable_gap();
  const bool met = gap <= std::min(tolerance, kExactReach) * extent_;
  const bool stuck = last_gap_ > 0.0 && gap > 0.5 * last_gap_;
  if (met || stuck) return false;
  last_gap_ = gap;
  shift_ = -energy_.constraints().residuals(x_);
  shift_pull_ = -energy_.constraints().gradient();
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
