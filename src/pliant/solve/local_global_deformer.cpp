#include "pliant/solve/local_global_deformer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/geometry/closest_rotation.h"
#include "pliant/geometry/normals.h"
#include "pliant/solve/local_global.h"

namespace pliant {
namespace {

/// Turns of handles below this (radians) need no prediction.
constexpr double kSmallTurn = 0.05;
/// Targets that a rigid motion meets to this part of the diagonal are met by a rigid motion.
constexpr double kRigid = 1e-9;
/// Energies below this, for weights of 1 and over the squared diagonal, are rounding.
constexpr double kNoise = 1e-20;

/// A model, and weight * sum |x - target|^2 over the points of handles.
class WithSoftHandles final : public LocalModel {
 public:
  WithSoftHandles(LocalModel& model, double weight, const std::vector<Handle>& handles)
      : model_(model), weight_(weight), handles_(handles) {}

  BlockMatrix matrix() const override {
    BlockMatrix matrix = model_.matrix();
    if (weight_ == 0.0) return matrix;
    for (const Handle& handle : handles_) {
      for (Index p : handle.points) matrix.diagonal[p] += weight_;
    }
    return matrix;
  }
  double evaluate(const Points& x, Points& half_gradient) override {
    const double energy = model_.evaluate(x, half_gradient);
    return energy + weight_ * add_pull(x, half_gradient);
  }
  void accept() override { model_.accept(); }
  void turned_gradient(const Points& from, const Rotations& turns, const Points& x,
                       Points& half_gradient) const override {
    model_.turned_gradient(from, turns, x, half_gradient);
    add_pull(x, half_gradient);
  }
  double slack() const override { return model_.slack(); }
  double stiffness() const override { return model_.stiffness(); }

 private:
  /// Adds the weighted pull; the sum of squared distances.
  double add_pull(const Points& x, Points& half_gradient) const {
    double sum = 0.0;
    if (weight_ == 0.0) return sum;
    for (const Handle& handle : handles_) {
      for (std::size_t i = 0; i < handle.points.size(); ++i) {
        const Index p = handle.points[i];
        const Eigen::Vector3d d = x.col(p) - handle.targets.col(static_cast<Index>(i));
        half_gradient.col(p) += weight_ * d;
        sum += d.squaredNorm();
      }
    }
    return sum;
  }

  LocalModel& model_;
  double weight_;
  const std::vector<Handle>& handles_;
};

}  // namespace

struct LocalGlobalDeformer::Core {
  Points x;
  LocalGlobal solver;
  std::optional<double> weight;  ///< of soft handles
  std::vector<Index> component;  ///< of each point

  bool pattern_changed = true;
  bool matrix_changed = false;
  bool targets_changed = true;
  int iteration = 0;
  /// E where the model was evaluated last at x and nothing has changed since.
  std::optional<double> energy_at_x;
  /// The motion a handle had when the targets were last taken; empty: moved by targets.
  std::map<HandleId, std::optional<Motion>> applied;

  WithSoftHandles energy(const LocalGlobalDeformer& self) const {
    return {self.model(), weight.value_or(0.0), self.handles()};
  }
  Points constrained(const LocalGlobalDeformer& self) const;
  Status set_up(const LocalGlobalDeformer& self);
  void take_targets(const LocalGlobalDeformer& self);
  bool follow_rigidly(const LocalGlobalDeformer& self, Points& start) const;
  std::pair<Points, bool> turns(const LocalGlobalDeformer& self);
  void try_start(LocalModel& model, Points start, bool always);
};

/// The present points, held ones where they should be.
Points LocalGlobalDeformer::Core::constrained(const LocalGlobalDeformer& self) const {
  Points points = x;
  for (Index p : self.fixed_points()) points.col(p) = self.shape().points().col(p);
  if (weight) return points;
  for (const Handle& handle : self.handles()) points(Eigen::all, handle.points) = handle.targets;
  return points;
}

Status LocalGlobalDeformer::Core::set_up(const LocalGlobalDeformer& self) {
  const BlockMatrix matrix = energy(self).matrix();
  component = parts_of(matrix);
  // A soft handle, too, keeps its part of the shape from floating.
  std::vector<bool> held(matrix.nodes, false);
  for (Index p : self.fixed_points()) held[p] = true;
  for (const Handle& handle : self.handles()) {
    for (Index p : handle.points) held[p] = true;
  }
  self.model().set_anchored(hold_one_a_part(component, held));
  for (const Handle& handle : self.handles()) {
    for (Index p : handle.points) held[p] = !weight;
  }
  if (Status s = solver.set_up(matrix, std::move(held)); !s.ok()) return s;
  pattern_changed = matrix_changed = false;
  targets_changed = true;
  iteration = 0;
  return {};
}

/// Moves every part that nothing fixes by the rigid motion that fits its handles best. True where
/// that meets all targets.
bool LocalGlobalDeformer::Core::follow_rigidly(const LocalGlobalDeformer& self, Points& start) const {
  std::map<Index, std::vector<std::pair<Index, Eigen::Vector3d>>> wanted;  // of each component
  for (const Handle& handle : self.handles()) {
    for (std::size_t i = 0; i < handle.points.size(); ++i) {
      wanted[component[handle.points[i]]].emplace_back(handle.points[i], handle.targets.col(static_cast<Index>(i)));
    }
  }
  for (Index p : self.fixed_points()) wanted.erase(component[p]);
  bool met = self.fixed_points().empty();
  for (const auto& [part, points] : wanted) {
    RigidFit fit;
    for (const auto& [p, target] : points) fit.add(x.col(p), target);
    const RigidMotion motion = fit.motion();
    for (const auto& [p, target] : points) {
      met =
          met && (motion.rotation * x.col(p) + motion.translation - target).norm() <= kRigid * self.shape().diagonal();
    }
    for (Index p = 0; p < start.cols(); ++p) {
      if (component[p] == part) start.col(p) = motion.rotation * x.col(p) + motion.translation;
    }
  }
  return met;
}

/// How far the handles turn from here, 3 x p rotation vectors at their points; and whether any was
/// told to turn by more than half a turn, which the points alone cannot show.
std::pair<Points, bool> LocalGlobalDeformer::Core::turns(const LocalGlobalDeformer& self) {
  bool beyond_half_turn = false;
  std::map<HandleId, Eigen::Vector3d> told;
  for (const Handle& handle : self.handles()) {
    const auto before = applied.try_emplace(handle.id, Motion{}).first;
    told[handle.id] =
        handle.motion ? turn_between(before->second, *handle.motion) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    beyond_half_turn = beyond_half_turn || told[handle.id].norm() > std::numbers::pi;
    before->second = handle.motion;
    if (!handle.motion && handle.targets == handle.rest) before->second = Motion{};
  }
  Points turns = Points::Zero(3, x.cols());
  for (const Handle& handle : self.handles()) {
    // Where no turn is told beyond what the points show, the points know better: soft ones may lag.
    RigidFit fit;
    for (std::size_t i = 0; i < handle.points.size(); ++i)
      fit.add(x.col(handle.points[i]), handle.targets.col(static_cast<Index>(i)));
    const Eigen::Vector3d turn = beyond_half_turn ? told[handle.id] : rotation_vector_of(fit.motion().rotation);
    for (Index p : handle.points) turns.col(p) = turn;
  }
  return {turns, beyond_half_turn};
}

/// Stands at `start` from now on if its energy is lower.
void LocalGlobalDeformer::Core::try_start(LocalModel& model, Points start, bool always) {
  Points unused;
  if (!always && !(model.evaluate(start, unused) < model.evaluate(x, unused))) return;
  x = std::move(start);
  solver.forget();
}

void LocalGlobalDeformer::Core::take_targets(const LocalGlobalDeformer& self) {
  targets_changed = false;
  solver.restart();
  const Points before = x;
  auto [rotations, beyond_half_turn] = turns(self);
  Points rigid = before;
  const bool met = follow_rigidly(self, rigid);
  x = constrained(self);
  WithSoftHandles model = energy(self);
  if (!beyond_half_turn && rigid != before) {
    x.swap(rigid);
    const Points start = constrained(self);
    x.swap(rigid);
    try_start(model, start, false);
    if (met) return;
  }
  if (rotations.colwise().norm().maxCoeff() < kSmallTurn) return;
  // The turns of the handles, spread as smoothly as the matrix can, and the points after them.
  solver.extend(rotations);
  Rotations spread(9, x.cols());
  for (Index p = 0; p < x.cols(); ++p) {
    spread.col(p) = rotation_of(rotations.col(p)).reshaped();
  }
  Points start = constrained(self), half_gradient;
  model.turned_gradient(before, spread, start, half_gradient);
  solver.relax(half_gradient, start);
  try_start(model, std::move(start), beyond_half_turn);
}

LocalGlobalDeformer::LocalGlobalDeformer(std::shared_ptr<const Shape> shape)
    : Deformer(std::move(shape)), core_(std::make_unique<Core>()) {
  core_->x = this->shape().points();
}
LocalGlobalDeformer::~LocalGlobalDeformer() = default;

void LocalGlobalDeformer::constraints_changed() { pattern_changed(); }
void LocalGlobalDeformer::targets_changed() {
  core_->targets_changed = true;
  core_->energy_at_x.reset();
}
void LocalGlobalDeformer::pattern_changed() {
  core_->pattern_changed = true;
  core_->energy_at_x.reset();
}
void LocalGlobalDeformer::matrix_changed() {
  core_->matrix_changed = true;
  core_->energy_at_x.reset();
}
void LocalGlobalDeformer::energy_changed() {
  core_->energy_at_x.reset();
  core_->solver.restart();
  core_->solver.forget();
}

void LocalGlobalDeformer::set_constraint_weight(std::optional<double> weight) {
  if (weight == core_->weight) return;
  weight && core_->weight ? matrix_changed() : pattern_changed();
  core_->weight = weight;
}

void LocalGlobalDeformer::do_reset() {
  core_->x = shape().points();
  core_->applied.clear();
  core_->targets_changed = true;
  core_->iteration = 0;
  energy_changed();
}

Result<StepReport> LocalGlobalDeformer::do_step(double tolerance) {
  Core& core = *core_;
  core.energy_at_x.reset();
  if (core.pattern_changed) {
    if (Status s = core.set_up(*this); !s.ok()) return s;
  } else if (core.matrix_changed) {
    if (Status s = core.solver.refactorize(core.energy(*this).matrix()); !s.ok()) return s;
    core.matrix_changed = false;
  }
  if (core.targets_changed) core.take_targets(*this);
  WithSoftHandles model = core.energy(*this);
  const double diagonal = shape().diagonal();
  const auto outcome =
      core.solver.step(model, core.x, tolerance, diagonal, kNoise * model.stiffness() * diagonal * diagonal);
  if (outcome.accepted) ++core.iteration;
  if (outcome.accepted && !core.weight) core.energy_at_x = core.solver.energy();
  return StepReport{core.iteration, core.solver.energy(), outcome.accepted, outcome.converged};
}

LocalGlobalDeformer::Terms LocalGlobalDeformer::evaluate_terms() const {
  Terms terms;
  if (core_->energy_at_x) {
    terms.model = *core_->energy_at_x;
    return terms;
  }
  Points unused;
  const Points x = core_->constrained(*this);
  terms.model = model().evaluate(x, unused);
  if (!core_->weight) return terms;
  for (const Handle& handle : handles()) {
    terms.constraint += (x(Eigen::all, handle.points) - handle.targets).squaredNorm();
  }
  return terms;
}

Counters LocalGlobalDeformer::counters() const {
  const LocalGlobal& solver = core_->solver;
  return {solver.unknowns(), solver.factorizations(), solver.analyses()};
}

Points LocalGlobalDeformer::point_positions() const { return core_->x; }

Points LocalGlobalDeformer::point_normals() const { return pliant::point_normals(core_->x, shape().triangles()); }

void LocalGlobalDeformer::save_result(State& state) const {
  const Points result = positions();
  state.add("result", 3, false).data.assign(result.data(), result.data() + result.size());
  save_handles(state);
}

Status LocalGlobalDeformer::restore(const State& state) {
  const StateTable* result = state.find("result");
  const std::size_t expected = 3 * static_cast<std::size_t>(shape().input_size());
  if (result == nullptr || result->data.size() != expected) {
    return {ErrorCode::invalid_option, "the state has no result of " + std::to_string(expected / 3) +
                                           " points; expected one of this method on this shape"};
  }
  if (!std::all_of(result->data.begin(), result->data.end(), [](double v) { return std::isfinite(v); })) {
    return {ErrorCode::invalid_option, "result of the state holds a number that is not finite"};
  }
  const Eigen::Map<const Points> points(result->data.data(), 3, shape().input_size());
  core_->x = points(Eigen::all, shape().vertex_of_point());
  core_->iteration = 0;
  core_->applied.clear();
  for (const Handle& handle : handles()) core_->applied[handle.id] = std::nullopt;
  energy_changed();
  return restore_handles(state);
}

}  // namespace pliant
