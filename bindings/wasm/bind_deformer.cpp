// Deformers: RawDeformer of bindings/js/boundary/raw.ts. One class for every method.
#include <memory>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <emscripten/bind.h>

#include "bound_deformation.h"
#include "bound_shape.h"
#include "pliant/deformers/registry.h"
#include "values.h"

namespace pliant::bindings {
namespace {

using emscripten::val;

struct StepValue {
  StatusValue status;
  int iteration = 0;
  double energy = 0.0;
  bool accepted = false;
  bool converged = false;
};

struct IdValue {
  StatusValue status;
  int id = 0;
};

struct CountValue {
  StatusValue status;
  Index added = 0;
};

Points to_points(const std::vector<double>& coordinates) {
  return Eigen::Map<const Points>(coordinates.data(), 3, coordinates.size() / 3);
}

/// Empty until `build` succeeds; the other calls need a deformer.
class BoundDeformer final : public BoundDeformation {
 public:
  StatusValue build(const BoundShape& shape, const std::string& method, const std::string& names,
                    const Scratch& scratch) {
    auto built = build_deformer(method, shape.get(), named_values(names, scratch));
    if (built.ok()) deformer_ = std::move(*built);
    return to_value(built.status());
  }
  StatusValue set_options(const std::string& names, const Scratch& scratch) {
    return to_value(deformer_->set_options(named_values(names, scratch)));
  }
  std::string options(Scratch& scratch) const { return stage(deformer_->options_by_name(), scratch); }
  PointsValue field() {
    Result<Points> field = deformer_->field();
    if (!field.ok()) return {to_value(field.status())};
    field_ = std::move(*field);
    return {to_value(Status()), view_of(field_)};
  }

  StatusValue set_fixed(const Scratch& scratch) { return to_value(deformer_->set_fixed(scratch.integers())); }
  IdValue add_handle(const Scratch& scratch) {
    const auto id = deformer_->add_handle(scratch.integers());
    return {to_value(id.status()), id.ok() ? *id : 0};
  }
  StatusValue remove_handle(int id) { return to_value(deformer_->remove_handle(id)); }
  StatusValue move_handle(int id, const std::string& names, const Scratch& scratch) {
    return with_fields<Motion>(names, scratch, [&](const Motion& to) { return deformer_->move_handle(id, to); });
  }
  StatusValue set_targets(int id, const Scratch& scratch) {
    return to_value(deformer_->set_targets(id, to_points(scratch.doubles())));
  }

  StepValue step(double tolerance) {
    const auto report = deformer_->step(tolerance);
    if (!report.ok()) return {to_value(report.status())};
    return {to_value(report.status()), report->iteration, report->energy, report->accepted, report->converged};
  }
  double energy_total() const { return deformer_->energy().total; }
  val energy_terms() const {
    val terms = val::array();
    for (const EnergyTerm& term : deformer_->energy().terms) terms.call<void>("push", term);
    return terms;
  }
  Counters counters() const { return deformer_->counters(); }

  CountValue refine() {
    const auto added = deformer_->refine();
    return {to_value(added.status()), added.ok() ? *added : 0};
  }

 private:
  Deformation& deformation() override { return *deformer_; }

  std::unique_ptr<Deformer> deformer_;
  Points field_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(pliant_deformer) {
  using emscripten::value_object;

  value_object<StepValue>("RawStep")
      .field("status", &StepValue::status)
      .field("iteration", &StepValue::iteration)
      .field("energy", &StepValue::energy)
      .field("accepted", &StepValue::accepted)
      .field("converged", &StepValue::converged);
  value_object<EnergyTerm>("RawEnergyTerm")
      .field("name", &EnergyTerm::name)
      .field("value", &EnergyTerm::value)
      .field("weight", &EnergyTerm::weight);
  value_object<Counters>("RawCounters")
      .field("unknowns", &Counters::unknowns)
      .field("factorizations", &Counters::factorizations)
      .field("analyses", &Counters::analyses);
  value_object<IdValue>("RawId").field("status", &IdValue::status).field("id", &IdValue::id);
  value_object<CountValue>("RawCount").field("status", &CountValue::status).field("added", &CountValue::added);

  emscripten::class_<BoundDeformer, emscripten::base<BoundDeformation>>("Deformer")
      .constructor<>()
      .function("build", &BoundDeformer::build)
      .function("setOptions", &BoundDeformer::set_options)
      .function("options", &BoundDeformer::options)
      .function("field", &BoundDeformer::field)
      .function("setFixed", &BoundDeformer::set_fixed)
      .function("addHandle", &BoundDeformer::add_handle)
      .function("removeHandle", &BoundDeformer::remove_handle)
      .function("moveHandle", &BoundDeformer::move_handle)
      .function("setTargets", &BoundDeformer::set_targets)
      .function("step", &BoundDeformer::step)
      .function("energyTotal", &BoundDeformer::energy_total)
      .function("energyTerms", &BoundDeformer::energy_terms)
      .function("counters", &BoundDeformer::counters)
      .function("refine", &BoundDeformer::refine);
}

}  // namespace pliant::bindings
