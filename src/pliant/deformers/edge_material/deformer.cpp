#include "pliant/deformers/edge_material/deformer.h"

#include <string>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/deformers/edge_material/field.h"
#include "pliant/deformers/edge_material/model.h"

namespace pliant {

using edge_material::EdgeElement;
using edge_material::EdgeMaterialModel;
using edge_material::MaterialWeights;

struct EdgeMaterial::Impl {
  explicit Impl(const Shape& shape) : model(shape) {}
  EdgeMaterialOptions options;
  EdgeMaterialModel model;
  Points field;  ///< at the points

  void apply_weights(const Shape& shape) {
    MaterialWeights weights;
    weights.lambda = options.lambda.value_or(options.stretch * model.resolution());
    weights.mu = options.bend;
    weights.p_stretch = options.p_stretch;
    weights.p_bend = options.p_bend;
    weights.pull = options.gravity * (weights.lambda * shape.diagonal() / shape.points().cols());
    model.set_weights(weights);
  }
};

EdgeMaterial::EdgeMaterial(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl)
    : LocalGlobalDeformer(std::move(shape)), impl_(std::move(impl)) {}
EdgeMaterial::~EdgeMaterial() = default;

Result<std::unique_ptr<EdgeMaterial>> EdgeMaterial::create(std::shared_ptr<const Shape> shape,
                                                           const EdgeMaterialOptions& options) {
  if (Status s = options.validate(*shape); !s.ok()) return s;
  if (shape->triangles().cols() == 0) {
    return Status(ErrorCode::invalid_shape, "the shape has no triangles; edge-material expects a surface");
  }
  shape = shape->in_local_order();
  auto field = edge_material::direction_field(*shape, options.field);
  if (!field.ok()) return field.status();
  auto impl = std::make_unique<Impl>(*shape);
  impl->options = options;
  impl->field = std::move(*field);
  impl->model.set_field(impl->field);
  impl->apply_weights(*shape);
  return std::unique_ptr<EdgeMaterial>(new EdgeMaterial(std::move(shape), std::move(impl)));
}

Status EdgeMaterial::set_options(const EdgeMaterialOptions& options) {
  if (Status s = options.validate(shape()); !s.ok()) return s;
  const bool other_field = !(options.field == impl_->options.field);
  if (other_field) {
    auto field = edge_material::direction_field(shape(), options.field);
    if (!field.ok()) return field.status();
    impl_->field = std::move(*field);
    impl_->model.set_field(impl_->field);
  }
  const MaterialWeights before = impl_->model.weights();
  impl_->options = options;
  impl_->apply_weights(shape());
  const MaterialWeights& now = impl_->model.weights();
  if (other_field || now.lambda != before.lambda || now.mu != before.mu) {
    matrix_changed();
  } else if (now.p_stretch != before.p_stretch || now.p_bend != before.p_bend || now.pull != before.pull) {
    energy_changed();
  }
  return {};
}

Status EdgeMaterial::set_options(const NamedValues& given) {
  EdgeMaterialOptions options = impl_->options;
  if (Status s = read(given, options); !s.ok()) return s;
  return set_options(options);
}

NamedValues EdgeMaterial::options_by_name() const { return named(impl_->options); }
const EdgeMaterialOptions& EdgeMaterial::options() const { return impl_->options; }
double EdgeMaterial::lambda() const { return impl_->model.weights().lambda; }
Result<Points> EdgeMaterial::field() const { return shape().scatter(impl_->field); }
LocalModel& EdgeMaterial::model() const { return impl_->model; }

Energy EdgeMaterial::energy() const {
  const double total = evaluate_terms().model;
  const EdgeMaterialModel& model = impl_->model;
  const MaterialWeights& w = model.weights();
  return {total,
          {{"stretch", model.stretch(), w.lambda * w.p_stretch},
           {"bend", model.bend(), w.mu * w.p_bend},
           {"gravity", model.gravity(), 1.0},
           {"constraint", 0.0, 1.0}}};  // E is taken with handles at their targets
}

State EdgeMaterial::do_save() const {
  const MaterialWeights& w = impl_->model.weights();
  const std::vector<Index>& vertex = shape().vertex_of_point();
  State state;
  const auto add_ids = [&](const char* name, Index EdgeElement::*field) {
    StateTable& table = state.add(name, 1, true);
    for (const EdgeElement& e : impl_->model.elements()) {
      table.data.push_back(e.*field < 0 ? -1 : vertex[e.*field]);
    }
  };
  const auto add_numbers = [&](const char* name, double EdgeElement::*field) {
    StateTable& table = state.add(name, 1, false);
    for (const EdgeElement& e : impl_->model.elements()) table.data.push_back(e.*field);
  };
  add_ids("edges[]/i", &EdgeElement::i);
  add_ids("edges[]/j", &EdgeElement::j);
  add_ids("edges[]/l", &EdgeElement::l);
  add_ids("edges[]/m", &EdgeElement::m);
  add_numbers("edges[]/alpha", &EdgeElement::alpha);
  add_numbers("edges[]/beta", &EdgeElement::beta);
  add_numbers("edges[]/rho", &EdgeElement::rho);
  add_numbers("edges[]/sigma", &EdgeElement::sigma);
  add_numbers("edges[]/kappa", &EdgeElement::kappa);
  const auto add_scalar = [&](const char* name, double value) { state.add(name, 0, false).data = {value}; };
  add_scalar("weights/lambda", w.lambda);
  add_scalar("weights/mu", w.mu);
  add_scalar("weights/pStretch", w.p_stretch);
  add_scalar("weights/pBend", w.p_bend);
  state.add("weights/gravity", 1, false).data = {w.pull.x(), w.pull.y(), w.pull.z()};
  StateTable& floating = state.add("floating", 1, true);
  for (Index v = 0; v < shape().input_size(); ++v) {
    if (!impl_->model.anchored(shape().point_of_vertex()[v])) floating.data.push_back(v);
  }
  const std::vector<Index> folded = impl_->model.folded(point_positions());
  state.add("folded[]/edge", 1, true).data.assign(folded.begin(), folded.end());
  StateTable& normals = state.add("folded[]/normal", 3, false);
  for (Index element : folded) {
    const Eigen::Vector3d normal = impl_->model.normal(element);
    normals.data.insert(normals.data.end(), normal.begin(), normal.end());
  }
  save_result(state);
  return state;
}

Status EdgeMaterial::do_restore(const State& state) {
  const StateTable* edges = state.find("folded[]/edge");
  const StateTable* normals = state.find("folded[]/normal");
  const std::vector<double> none;
  const std::vector<double>& folded = edges != nullptr ? edges->data : none;
  if (3 * folded.size() != (normals != nullptr ? normals->data.size() : 0)) {
    return {ErrorCode::invalid_option,
            "folded of the state has edges and normals of different numbers; expected as many"};
  }
  const double count = static_cast<double>(impl_->model.elements().size());
  for (double edge : folded) {
    if (edge >= 0.0 && edge < count) continue;
    return {ErrorCode::invalid_option,
            message({"folded of the state holds edge ", edge, "; expected 0 to ", count - 1.0})};
  }
  if (Status s = LocalGlobalDeformer::do_restore(state); !s.ok()) return s;
  for (std::size_t k = 0; k < folded.size(); ++k) {
    impl_->model.set_normal(static_cast<Index>(folded[k]), Eigen::Vector3d(&normals->data[3 * k]));
  }
  return {};
}

}  // namespace pliant
