#include "pliant/deformers/arap/deformer.h"

#include <utility>

#include "pliant/deformers/arap/model.h"

namespace pliant {

struct Arap::Impl {
  ArapOptions options;
  std::unique_ptr<arap::ArapModel> model;
};

Arap::Arap(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl)
    : LocalGlobalDeformer(std::move(shape)), impl_(std::move(impl)) {
  set_constraint_weight(impl_->options.constraint_weight);
}
Arap::~Arap() = default;

Result<std::unique_ptr<Arap>> Arap::create(std::shared_ptr<const Shape> shape, const ArapOptions& options) {
  if (Status s = options.validate(); !s.ok()) return s;
  if (shape->triangles().cols() == 0) {
    return Status(ErrorCode::invalid_shape, "the shape has no triangles; arap expects a surface");
  }
  shape = shape->in_local_order();
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->model = std::make_unique<arap::ArapModel>(*shape, options);
  return std::unique_ptr<Arap>(new Arap(std::move(shape), std::move(impl)));
}

Status Arap::set_options(const ArapOptions& options) {
  if (Status s = options.validate(); !s.ok()) return s;
  const ArapOptions before = std::exchange(impl_->options, options);
  set_constraint_weight(options.constraint_weight);
  if (options.energy == before.energy && options.smoothness == before.smoothness) return {};
  impl_->model = std::make_unique<arap::ArapModel>(shape(), options);
  if ((options.smoothness > 0.0) == (before.smoothness > 0.0)) {
    matrix_changed();
  } else {
    pattern_changed();
  }
  return {};
}

Status Arap::set_options(const NamedValues& given) {
  ArapOptions options = impl_->options;
  if (Status s = read(given, options); !s.ok()) return s;
  return set_options(options);
}

NamedValues Arap::options_by_name() const { return named(impl_->options); }
const ArapOptions& Arap::options() const { return impl_->options; }
LocalModel& Arap::model() const { return *impl_->model; }

Energy Arap::energy() const {
  const Terms terms = evaluate_terms();
  Energy energy{terms.model, {{"rigidity", impl_->model->rigidity(), 1.0}}};
  if (impl_->options.smoothness > 0.0) {
    energy.terms.push_back({"smoothness", impl_->model->smoothness(), 1.0});
  }
  if (const auto weight = impl_->options.constraint_weight) {
    energy.terms.push_back({"constraint", terms.constraint, *weight});
    energy.total += *weight * terms.constraint;
  }
  return energy;
}

State Arap::do_save() const {
  const arap::ArapModel& model = *impl_->model;
  State state;
  StateTable i{"edges[]/i", 1, true, {}}, j{"edges[]/j", 1, true, {}},
      weight{"edges[]/weight", 1, false, model.spoke_weights()};
  for (std::size_t e = 0; e < model.edges().size(); ++e) {
    i.data.push_back(shape().vertex_of_point()[model.edges()[e][0]]);
    j.data.push_back(shape().vertex_of_point()[model.edges()[e][1]]);
  }
  for (StateTable* table : {&i, &j, &weight}) state.tables.push_back(std::move(*table));
  evaluate_terms();  // rotations of the present points
  StateTable& rotations = state.add("rotations", 9, false);
  for (Index point : shape().point_of_vertex()) {
    const Eigen::Map<const Eigen::Matrix3d> r(model.rotations().col(point).data());
    for (int k = 0; k < 9; ++k) rotations.data.push_back(r(k / 3, k % 3));
  }
  save_result(state);
  return state;
}

}  // namespace pliant
