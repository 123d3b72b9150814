#include "pliant/deformers/embedded_graph/deformer.h"

#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pliant/core/message.h"
#include "pliant/deformers/embedded_graph/graph.h"
#include "pliant/deformers/embedded_graph/refine.h"
#include "pliant/deformers/embedded_graph/solver.h"
#include "pliant/deformers/embedded_graph/start.h"
#include "pliant/solve/carry.h"

namespace pliant {

using embedded::GraphEnergy;
using embedded::GraphSolver;
using embedded::Pose;

struct EmbeddedGraph::Impl {
  EmbeddedGraphOptions options;
  DeformationGraph graph;
  Pose pose;  ///< of all nodes
  GraphSolver solver;
  Points rest_normals;

  embedded::GraphStart start{solver};
  bool refined = false;
  bool solver_knows_graph = false;  ///< it was set up over the present nodes

  /// The pose is another: the solver goes on from there with what it has factorised, if nothing else changes.
  void take_pose(const std::vector<Index>& fixed_points);

  embedded::Weights weights() const {
    return {options.rotation_weight, options.regularization_weight, options.constraint_weight};
  }
  embedded::Terms terms_of(const Shape& shape, const Constraints& constraints) const;
  /// Of each node, weighted: its rotation term, and the regularisation of its edges to others.
  std::vector<double> node_energies() const;
  PackedMaps position_maps() const;
  PackedMaps normal_maps() const;
};

namespace {

Influences rows_of(const Influences& influences, const std::vector<Index>& rows) {
  Influences some;
  some.k = influences.k;
  some.indices.reserve(rows.size() * influences.k);
  some.weights.reserve(rows.size() * influences.k);
  for (Index row : rows) {
    const auto from = static_cast<std::ptrdiff_t>(row) * influences.k;
    some.indices.insert(some.indices.end(), influences.indices.begin() + from,
                        influences.indices.begin() + from + influences.k);
    some.weights.insert(some.weights.end(), influences.weights.begin() + from,
                        influences.weights.begin() + from + influences.k);
  }
  return some;
}

/// Every node that influences a fixed point leaves the unknowns.
std::vector<bool> frozen_nodes(const DeformationGraph& graph, const std::vector<Index>& fixed_points) {
  std::vector<bool> frozen(graph.size(), false);
  const int k = graph.influences.k;
  for (Index point : fixed_points) {
    for (int s = 0; s < k; ++s) {
      const std::size_t at = static_cast<std::size_t>(point) * k + s;
      if (graph.influences.weights[at] > 0.0) frozen[graph.influences.indices[at]] = true;
    }
  }
  return frozen;
}

}  // namespace

void EmbeddedGraph::Impl::take_pose(const std::vector<Index>& fixed_points) {
  const std::vector<bool> frozen = frozen_nodes(graph, fixed_points);
  for (Index j = 0; j < graph.size(); ++j) {
    if (frozen[j]) pose.col(j).setZero();
  }
  if (solver_knows_graph) solver.set_pose(pose);
}

embedded::Terms EmbeddedGraph::Impl::terms_of(const Shape& shape, const Constraints& constraints) const {
  const std::vector<Index> moved = constraints.moved_points();
  const Points rest = graph.scaled(shape.points()(Eigen::all, moved));
  GraphEnergy energy;
  energy.set_up(graph, std::vector<bool>(graph.size(), false), rest, rows_of(graph.influences, moved), weights());
  energy.constraints().set_targets(graph.scaled(constraints.targets()) - rest);
  const embedded::Vector x = embedded::unknowns_of(pose);
  energy.evaluate(x);
  embedded::Terms terms = energy.terms();
  terms.barrier = embedded::barrier::sum(energy, x);
  return terms;
}

std::vector<double> EmbeddedGraph::Impl::node_energies() const {
  GraphEnergy energy;
  energy.set_up(graph, std::vector<bool>(graph.size(), false), Points(3, 0), Influences{graph.influences.k, {}, {}},
                weights());
  const embedded::Vector x = embedded::unknowns_of(pose);
  energy.evaluate(x);
  return energy.node_energies(x);
}

PackedMaps EmbeddedGraph::Impl::position_maps() const {
  PackedMaps maps(12, graph.size());
  for (Index j = 0; j < graph.size(); ++j) {
    const Eigen::Matrix3d u = embedded::gradient_of(pose, j);
    const Eigen::Vector3d t = graph.length_unit * embedded::translation_of(pose, j);
    maps.col(j) = pack_map(u, t - u * (graph.nodes.col(j) - graph.origin));
  }
  return maps;
}

PackedMaps EmbeddedGraph::Impl::normal_maps() const {
  // Eq. 3 with cofactors in the place of the inverse transpose: defined for every R.
  PackedMaps maps(12, graph.size());
  for (Index j = 0; j < graph.size(); ++j) {
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + embedded::gradient_of(pose, j);
    maps.col(j) = pack_map(embedded::cofactors(r) - Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  }
  return maps;
}

EmbeddedGraph::EmbeddedGraph(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl)
    : Deformer(std::move(shape)), impl_(std::move(impl)) {}
EmbeddedGraph::~EmbeddedGraph() = default;

Result<std::unique_ptr<EmbeddedGraph>> EmbeddedGraph::create(std::shared_ptr<const Shape> shape,
                                                             const EmbeddedGraphOptions& options) {
  if (Status s = options.validate(*shape); !s.ok()) return s;
  auto nodes = place_nodes(*shape, options);
  if (!nodes.ok()) return nodes.status();
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->graph = build_graph(*shape, std::move(*nodes), options);
  impl->pose.setZero(12, impl->graph.size());
  impl->rest_normals = shape->normals();
  return std::unique_ptr<EmbeddedGraph>(new EmbeddedGraph(std::move(shape), std::move(impl)));
}

Status EmbeddedGraph::set_up() {
  Impl& impl = *impl_;
  const DeformationGraph& graph = impl.graph;
  const std::vector<bool> frozen = frozen_nodes(graph, fixed_points());
  Pose pose = impl.pose;
  for (Index j = 0; j < graph.size(); ++j) {
    if (frozen[j]) pose.col(j).setZero();
  }
  const std::vector<Index> moved = constraints().moved_points();
  const Influences influences = rows_of(graph.influences, moved);
  const Points rest = graph.scaled(shape().points()(Eigen::all, moved));
  const EmbeddedGraphOptions& options = impl.options;
  Status status = impl.solver.set_up(graph, frozen, rest, influences,
                                     {impl.weights(), options.solver, options.exact_handles}, pose);
  if (!status.ok()) return status;
  impl.solver_knows_graph = true;
  impl.start.set_up(graph, influences, handles());
  impl.pose = std::move(pose);
  return {};
}

Start& EmbeddedGraph::take_targets() {
  Points targets = constraints().targets();
  impl_->solver.set_targets(impl_->graph.scaled(targets));
  impl_->start.set_targets(std::move(targets));
  return impl_->start;
}

Result<StepReport> EmbeddedGraph::iterate(double tolerance) {
  const auto outcome = impl_->solver.step(tolerance);
  if (!outcome.ok()) {
    pattern_changed();  // what was factorised last is of no use
    return outcome.status();
  }
  impl_->solver.store(impl_->pose);
  return StepReport{0, impl_->solver.terms().total(impl_->weights()), outcome->accepted, outcome->converged};
}

void EmbeddedGraph::do_reset() {
  impl_->pose.setZero();
  impl_->take_pose(fixed_points());
}

Energy EmbeddedGraph::energy() const {
  const embedded::Weights w = impl_->weights();
  const embedded::Terms terms = up_to_date() ? impl_->solver.terms() : impl_->terms_of(shape(), constraints());
  Energy energy{terms.total(w),
                {{"rotation", terms.rotation, w.rotation},
                 {"regularization", terms.regularization, w.regularization},
                 {"constraint", terms.constraint, w.constraint}}};
  if (terms.barrier > 0.0) energy.terms.push_back({"barrier", terms.barrier, w.rotation});
  return energy;
}

Counters EmbeddedGraph::counters() const {
  const GraphSolver& solver = impl_->solver;
  return {solver.energy().unknowns(), solver.factorizations(), solver.analyses()};
}

Points EmbeddedGraph::point_positions() const {
  Points out;
  carry(impl_->position_maps(), impl_->graph.influences, shape().points(), impl_->graph.origin, out);
  return out;
}

Points EmbeddedGraph::point_normals() const {
  Points out;
  carry(impl_->normal_maps(), impl_->graph.influences, impl_->rest_normals, Eigen::Vector3d::Zero(), out);
  for (Index i = 0; i < out.cols(); ++i) {
    const double length = out.col(i).norm();
    if (length > 0.0) out.col(i) /= length;
  }
  return out;
}

Result<Points> EmbeddedGraph::transform_points(const Points& points) const {
  Points out;
  carry(impl_->position_maps(), compute_influences(shape(), impl_->graph, points), points, impl_->graph.origin, out);
  return out;
}

Result<Index> EmbeddedGraph::refine(Index max_nodes) {
  if (max_nodes < 1) {
    return Status(ErrorCode::invalid_option, message({"refine: maxNodes is ", max_nodes, "; expected at least 1"}));
  }
  if (!up_to_date()) return Index{0};  // nothing solved: no terms to go by
  const Points fresh = embedded::nodes_to_add(shape(), impl_->graph, impl_->solver, max_nodes);
  if (fresh.cols() == 0) return Index{0};
  Points nodes(3, impl_->graph.size() + fresh.cols());
  nodes << impl_->graph.nodes, fresh;
  DeformationGraph refined = build_graph(shape(), std::move(nodes), impl_->options);
  impl_->pose = embedded::inherited_pose(shape(), impl_->graph, impl_->pose, refined);
  impl_->graph = std::move(refined);
  impl_->solver_knows_graph = false;
  pattern_changed();
  return static_cast<Index>(fresh.cols());
}

Result<Index> EmbeddedGraph::refine() {
  if (!impl_->options.refine || impl_->refined) return Index{0};
  const Result<Index> added = refine((impl_->options.wanted_nodes(shape()) + 1) / 2);
  impl_->refined = added.ok();
  return added;
}

NamedValues EmbeddedGraph::options_by_name() const {
  EmbeddedGraphOptions options = impl_->options;
  if (options.sampling != NodeSampling::nodes) options.node_count = options.wanted_nodes(shape());
  options.neighbours = impl_->graph.influences.k;
  return named(std::move(options));
}

State EmbeddedGraph::do_save() const {
  const DeformationGraph& graph = impl_->graph;
  State state;
  auto copy = [&](const char* name, int columns, const auto& data, bool integral) {
    state.add(name, columns, integral).data.assign(data.begin(), data.end());
  };
  copy("nodes", 3, std::span(graph.nodes.data(), graph.nodes.size()), false);
  StateTable rotations{"rotations", 9, false, {}}, translations{"translations", 3, false, {}};
  for (Index j = 0; j < graph.size(); ++j) {
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + embedded::gradient_of(impl_->pose, j);
    const Eigen::Vector3d t = graph.length_unit * embedded::translation_of(impl_->pose, j);
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) rotations.data.push_back(r(a, c));
    }
    translations.data.insert(translations.data.end(), t.begin(), t.end());
  }
  state.tables.push_back(std::move(rotations));
  state.tables.push_back(std::move(translations));
  StateTable& edges = state.add("edges", 2, true);
  for (const auto& [j, k] : graph.edges) edges.data.insert(edges.data.end(), {double(j), double(k)});
  const std::vector<bool> is_frozen = frozen_nodes(graph, fixed_points());
  StateTable& frozen = state.add("frozen", 1, true);
  for (Index j = 0; j < graph.size(); ++j) {
    if (is_frozen[j]) frozen.data.push_back(j);
  }
  state.add("influences/k", 0, true).data = {static_cast<double>(graph.influences.k)};
  const Influences influences = rows_of(graph.influences, shape().point_of_vertex());
  copy("influences/indices", 1, influences.indices, true);
  copy("influences/weights", 1, influences.weights, false);
  state.add("lengthUnit", 0, false).data = {graph.length_unit};
  state.add("energies", 1, false).data = impl_->node_energies();
  return state;
}

Status EmbeddedGraph::do_restore(const State& state) {
  const StateTable* nodes = state.find("nodes");
  const StateTable* rotations = state.find("rotations");
  const StateTable* translations = state.find("translations");
  if (nodes == nullptr || rotations == nullptr || translations == nullptr) {
    return {ErrorCode::invalid_option,
            "state lacks nodes, rotations or translations; expected a state of embedded-graph"};
  }
  const std::size_t m = nodes->data.size() / 3;
  if (m == 0 || nodes->data.size() != 3 * m || rotations->data.size() != 9 * m || translations->data.size() != 3 * m) {
    return {ErrorCode::invalid_option,
            "nodes, rotations and translations of the state differ in length; expected one of each "
            "a node"};
  }
  for (const StateTable* table : {nodes, rotations, translations}) {
    for (double value : table->data) {
      if (!std::isfinite(value))
        return {ErrorCode::invalid_option, table->name + " of the state holds a number that is not finite"};
    }
  }
  const Points positions = Eigen::Map<const Points>(nodes->data.data(), 3, static_cast<Index>(m));
  if (positions.cols() != impl_->graph.nodes.cols() || positions != impl_->graph.nodes) {
    impl_->graph = build_graph(shape(), positions, impl_->options);
    impl_->solver_knows_graph = false;
    pattern_changed();
  }
  impl_->pose.setZero(12, impl_->graph.size());
  for (Index j = 0; j < impl_->graph.size(); ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) {
        impl_->pose(4 * a + c, j) = rotations->data[9 * j + 3 * a + c] - (a == c ? 1.0 : 0.0);
      }
      impl_->pose(4 * a + 3, j) = translations->data[3 * j + a] / impl_->graph.length_unit;
    }
  }
  impl_->take_pose(fixed_points());
  return {};
}

}  // namespace pliant
