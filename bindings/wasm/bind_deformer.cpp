// Deformers: RawDeformer of bindings/js/boundary/raw.ts. One class for every method; only build* differ.
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <emscripten/bind.h>

#include "bound_deformation.h"
#include "bound_shape.h"
#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/edge_material/deformer.h"
#include "pliant/deformers/embedded_graph/deformer.h"

namespace pliant::bindings {
namespace {

using emscripten::val;

/// RawEmbeddedGraphOptions. Names of choices are checked in bindings/js.
struct EmbeddedGraphValues {
  Index node_count;
  std::string sampling;
  int neighbours;
  double rotation_weight, regularization_weight, constraint_weight;
  std::string solver;
  bool exact_handles;
  double seed;
};

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

NodeSampling sampling_of(const std::string& name) {
  if (name == "nodes") return NodeSampling::nodes;
  return name == "simplify" ? NodeSampling::simplify : NodeSampling::surface;
}

/// |a|, a..., |b|, b... for each pair.
std::vector<Cut> to_cuts(const std::vector<std::int32_t>& packed) {
  std::vector<Cut> cuts;
  auto next = packed.begin();
  const auto take = [&next] {
    const auto first = next + 1;
    next = first + *next;
    return std::vector<Index>(first, next);
  };
  while (next != packed.end()) {
    Cut& cut = cuts.emplace_back();
    cut.a = take();
    cut.b = take();
  }
  return cuts;
}

EmbeddedGraphOptions to_options(const EmbeddedGraphValues& values, const Scratch& scratch) {
  EmbeddedGraphOptions options;
  options.node_count = values.node_count;
  options.sampling = sampling_of(values.sampling);
  if (options.sampling == NodeSampling::nodes) options.nodes = to_points(scratch.doubles());
  options.neighbours = values.neighbours;
  options.rotation_weight = values.rotation_weight;
  options.regularization_weight = values.regularization_weight;
  options.constraint_weight = values.constraint_weight;
  options.solver = values.solver == "gauss-newton" ? EmbeddedGraphSolver::gauss_newton : EmbeddedGraphSolver::automatic;
  options.exact_handles = values.exact_handles;
  options.cuts = to_cuts(scratch.integers());
  options.seed = static_cast<std::uint64_t>(values.seed);
  return options;
}

/// constraint_weight 0: exact handles.
ArapOptions to_options(bool rims, double constraint_weight, double smoothness) {
  ArapOptions options;
  options.energy = rims ? ArapEnergy::spokes_and_rims : ArapEnergy::spokes;
  if (constraint_weight > 0.0) options.constraint_weight = constraint_weight;
  options.smoothness = smoothness;
  return options;
}

/// integers: points of each stroke, or source vertices; coordinates: of all strokes.
DirectionField to_field(const std::string& kind, const std::vector<std::int32_t>& integers,
                        std::span<const double> coordinates) {
  using Kind = DirectionField::Kind;
  DirectionField field;
  if (kind == "axis") field.kind = Kind::axis;
  if (kind == "max") field.kind = Kind::curvature_max;
  if (kind == "min") field.kind = Kind::curvature_min;
  if (kind == "geodesic") {
    field.kind = Kind::geodesic;
    field.sources = integers;
  }
  if (kind != "strokes") return field;
  field.kind = Kind::strokes;
  for (std::size_t from = 0; const std::int32_t count : integers) {
    field.strokes.emplace_back(Eigen::Map<const Points>(&coordinates[from], 3, count));
    from += 3 * count;
  }
  return field;
}

/// stretch, lambda (below 0: from stretch), bend, pStretch, pBend, gravity xyz, axis xyz, strokes.
EdgeMaterialOptions to_options(const std::string& field, const Scratch& scratch) {
  const std::vector<double>& v = scratch.doubles();
  EdgeMaterialOptions options;
  options.stretch = v[0];
  if (v[1] >= 0.0) options.lambda = v[1];
  options.bend = v[2];
  options.p_stretch = v[3];
  options.p_bend = v[4];
  options.gravity = {v[5], v[6], v[7]};
  options.field = to_field(field, scratch.integers(), std::span(v).subspan(11));
  options.field.axis = {v[8], v[9], v[10]};
  return options;
}

/// scale, center xyz, axis xyz, angle, about xyz, translation xyz.
Motion to_motion(const std::vector<double>& v) {
  Motion motion;
  motion.scale = v[0];
  motion.center = {v[1], v[2], v[3]};
  motion.axis = {v[4], v[5], v[6]};
  motion.angle = v[7];
  motion.about = {v[8], v[9], v[10]};
  motion.translation = {v[11], v[12], v[13]};
  return motion;
}

/// Empty until a build* succeeds; the other calls need a deformer.
class BoundDeformer final : public BoundDeformation {
 public:
  StatusValue build_embedded_graph(const BoundShape& shape, const EmbeddedGraphValues& values, const Scratch& scratch) {
    return take(EmbeddedGraph::create(shape.get(), to_options(values, scratch)));
  }
  StatusValue build_arap(const BoundShape& shape, bool rims, double constraint_weight, double smoothness) {
    return take(Arap::create(shape.get(), to_options(rims, constraint_weight, smoothness)));
  }
  StatusValue set_arap(bool rims, double constraint_weight, double smoothness) {
    return to_value(as<Arap>().set_options(to_options(rims, constraint_weight, smoothness)));
  }
  StatusValue build_edge_material(const BoundShape& shape, const std::string& field, const Scratch& scratch) {
    return take(EdgeMaterial::create(shape.get(), to_options(field, scratch)));
  }
  StatusValue set_edge_material(const std::string& field, const Scratch& scratch) {
    return to_value(as<EdgeMaterial>().set_options(to_options(field, scratch)));
  }
  val field() {
    field_ = as<EdgeMaterial>().field();
    return view_of(field_);
  }

  StatusValue set_fixed(const Scratch& scratch) { return to_value(deformer_->set_fixed(scratch.integers())); }
  IdValue add_handle(const Scratch& scratch) {
    const auto id = deformer_->add_handle(scratch.integers());
    return {to_value(id.status()), id.ok() ? *id : 0};
  }
  StatusValue remove_handle(int id) { return to_value(deformer_->remove_handle(id)); }
  StatusValue move_handle(int id, const Scratch& scratch) {
    return to_value(deformer_->move_handle(id, to_motion(scratch.doubles())));
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

  CountValue refine(Index max_nodes) {
    const auto added = as<EmbeddedGraph>().refine(max_nodes);
    return {to_value(added.status()), added.ok() ? *added : 0};
  }

 private:
  Deformation& deformation() override { return *deformer_; }
  template <class Method>
  StatusValue take(Result<std::unique_ptr<Method>> built) {
    if (built.ok()) deformer_ = std::move(*built);
    return to_value(built.status());
  }
  /// Calls of one method come from bindings/js, which knows what it has built.
  template <class Method>
  Method& as() {
    return static_cast<Method&>(*deformer_);
  }

  std::unique_ptr<Deformer> deformer_;
  Points field_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(pliant_deformer) {
  using emscripten::value_object;

  value_object<EmbeddedGraphValues>("RawEmbeddedGraphOptions")
      .field("nodeCount", &EmbeddedGraphValues::node_count)
      .field("sampling", &EmbeddedGraphValues::sampling)
      .field("neighbours", &EmbeddedGraphValues::neighbours)
      .field("rotationWeight", &EmbeddedGraphValues::rotation_weight)
      .field("regularizationWeight", &EmbeddedGraphValues::regularization_weight)
      .field("constraintWeight", &EmbeddedGraphValues::constraint_weight)
      .field("solver", &EmbeddedGraphValues::solver)
      .field("exactHandles", &EmbeddedGraphValues::exact_handles)
      .field("seed", &EmbeddedGraphValues::seed);
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
      .function("buildEmbeddedGraph", &BoundDeformer::build_embedded_graph)
      .function("buildArap", &BoundDeformer::build_arap)
      .function("setArap", &BoundDeformer::set_arap)
      .function("buildEdgeMaterial", &BoundDeformer::build_edge_material)
      .function("setEdgeMaterial", &BoundDeformer::set_edge_material)
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
