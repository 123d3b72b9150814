#include "pliant/solve/local_global_deformer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/geometry/closest_rotation.h"
#include "pliant/geometry/normals.h"
#include "pliant/solve/local_global.h"

namespace pliant {
namespace {

/// Turns of handles below this (radians) need no prediction.
constexpr double kSmallTurn = 0.05;
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

/// The deformation, and how it is started anew.
struct LocalGlobalDeformer::Core final : Start {
  explicit Core(const LocalGlobalDeformer& deformer) : self(deformer), x(deformer.shape().points()) {}

  const LocalGlobalDeformer& self;
  Points x;
  Points before;  ///< the same before held points went to their targets
  LocalGlobal solver;
  std::optional<double> weight;  ///< of soft handles
  std::vector<Index> parts;      ///< of the points
  std::vector<bool> fixed_part;
  std::vector<Index> moved;  ///< Constraints::moved_points
  /// E where the model was evaluated last at x and nothing has changed since.
  std::optional<double> energy_at_x;

  WithSoftHandles energy() const { return {self.model(), weight.value_or(0.0), self.handles()}; }
  Points constrained(Points points) const;
  bool keep_if_lower(Points start, bool in_any_case);

  double small_turn() const override { return kSmallTurn; }
  Eigen::Vector3d standing(Index i) const override { return before.col(moved[i]); }
  Index part_count() const override { return static_cast<Index>(fixed_part.size()); }
  bool floats(Index part) const override { return !fixed_part[part]; }
  Index part_of(Index i) const override { return parts[moved[i]]; }
  void try_rigid(const std::vector<PartMotion>& motions) override;
  void try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) override;
};

/// Points with held ones where they should be.
Points LocalGlobalDeformer::Core::constrained(Points points) const {
  for (Index p : self.fixed_points()) points.col(p) = self.shape().points().col(p);
  if (weight) return points;
  for (const Handle& handle : self.handles()) points(Eigen::all, handle.points) = handle.targets;
  return points;
}

/// Stands at `start` from now on if its energy is lower.
bool LocalGlobalDeformer::Core::keep_if_lower(Points start, bool in_any_case) {
  Points unused;
  WithSoftHandles model = energy();
  if (!in_any_case && !(model.evaluate(start, unused) < model.evaluate(x, unused))) return false;
  x = std::move(start);
  solver.forget();
  return true;
}

void LocalGlobalDeformer::Core::try_rigid(const std::vector<PartMotion>& motions) {
  Points rigid = before;
  for (const auto& [part, motion] : motions) {
    for (Index p = 0; p < rigid.cols(); ++p) {
      if (parts[p] == part) rigid.col(p) = motion.rotation * rigid.col(p) + motion.translation;
    }
  }
  if (keep_if_lower(constrained(rigid), false)) before = std::move(rigid);
}

void LocalGlobalDeformer::Core::try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) {
  Points rotations = Points::Zero(3, x.cols());
  for (std::size_t h = 0; h < turns.size(); ++h) {
    for (Index p : self.handles()[h].points) rotations.col(p) = turns[h];
  }
  solver.extend(rotations);
  Rotations spread(9, x.cols());
  for (Index p = 0; p < x.cols(); ++p) spread.col(p) = rotation_of(rotations.col(p)).reshaped();
  Points start = x, half_gradient;
  energy().turned_gradient(before, spread, start, half_gradient);
  solver.relax(half_gradient, start);
  keep_if_lower(std::move(start), in_any_case);
}

LocalGlobalDeformer::LocalGlobalDeformer(std::shared_ptr<const Shape> shape)
    : Deformer(std::move(shape)), core_(std::make_unique<Core>(*this)) {}
LocalGlobalDeformer::~LocalGlobalDeformer() = default;

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

Status LocalGlobalDeformer::set_up() {
  Core& core = *core_;
  const BlockMatrix matrix = core.energy().matrix();
  core.parts = parts_of(matrix);
  core.moved = constraints().moved_points();
  core.fixed_part.assign(core.parts.empty() ? 0 : *std::max_element(core.parts.begin(), core.parts.end()) + 1, false);
  for (Index p : fixed_points()) core.fixed_part[core.parts[p]] = true;
  // A soft handle, too, keeps its part of the shape from floating.
  std::vector<bool> held = constraints().held();
  model().set_anchored(hold_one_a_part(core.parts, held));
  for (Index p : core.moved) held[p] = !core.weight;
  return core.solver.set_up(matrix, std::move(held));
}

Status LocalGlobalDeformer::refactorize() { return core_->solver.refactorize(core_->energy().matrix()); }

Start& LocalGlobalDeformer::take_targets() {
  core_->solver.restart();
  core_->before = core_->x;
  core_->x = core_->constrained(core_->x);
  return *core_;
}

Result<StepReport> LocalGlobalDeformer::iterate(double tolerance) {
  Core& core = *core_;
  WithSoftHandles model = core.energy();
  const double diagonal = shape().diagonal();
  const auto outcome =
      core.solver.step(model, core.x, tolerance, diagonal, kNoise * model.stiffness() * diagonal * diagonal);
  core.energy_at_x.reset();
  if (outcome.accepted && !core.weight) core.energy_at_x = core.solver.energy();
  return StepReport{0, core.solver.energy(), outcome.accepted, outcome.converged};
}

void LocalGlobalDeformer::do_reset() {
  core_->x = shape().points();
  energy_changed();
}

LocalGlobalDeformer::Terms LocalGlobalDeformer::evaluate_terms() const {
  Terms terms;
  if (core_->energy_at_x && up_to_date()) {
    terms.model = *core_->energy_at_x;
    return terms;
  }
  Points unused;
  const Points x = core_->constrained(core_->x);
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
}

Status LocalGlobalDeformer::do_restore(const State& state) {
  const StateTable* result = state.find("result");
  const std::size_t expected = 3 * static_cast<std::size_t>(shape().input_size());
  if (result == nullptr || result->data.size() != expected) {
    return {ErrorCode::invalid_option, message({"the state has no result of ", expected / 3,
                                                " points; expected one of this method on this shape"})};
  }
  if (!std::all_of(result->data.begin(), result->data.end(), [](double v) { return std::isfinite(v); })) {
    return {ErrorCode::invalid_option, "result of the state holds a number that is not finite"};
  }
  const Eigen::Map<const Points> points(result->data.data(), 3, shape().input_size());
  core_->x = points(Eigen::all, shape().vertex_of_point());
  energy_changed();
  return {};
}

}  // namespace pliant
