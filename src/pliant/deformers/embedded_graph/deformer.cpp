#include "pliant/deformers/embedded_graph/deformer.h"

#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pliant/deformers/embedded_graph/graph.h"
#include "pliant/deformers/embedded_graph/refine.h"
#include "pliant/deformers/embedded_graph/solver.h"
#include "pliant/deformers/embedded_graph/transfer.h"

namespace pliant {

using embedded::GraphEnergy;
using embedded::GraphSolver;
using embedded::PackedMaps;
using embedded::Pose;
using embedded::Turn;

struct EmbeddedGraph::Impl {
  EmbeddedGraphOptions options;
  DeformationGraph graph;
  Pose pose;  ///< of all nodes
  GraphSolver solver;
  Points rest_normals;

  bool grab_changed = true;
  bool targets_changed = true;
  int iteration = 0;
  /// The motion a handle had when the targets were last taken; empty: moved by targets.
  std::map<HandleId, std::optional<Motion>> applied;

  embedded::Weights weights() const {
    return {options.rotation_weight, options.regularization_weight, options.constraint_weight};
  }
  Status set_up(const EmbeddedGraph& self);
  void take_targets(const EmbeddedGraph& self);
  std::vector<Turn> turns(const std::vector<Handle>& handles);
  embedded::Terms terms(const EmbeddedGraph& self) const;
  PackedMaps position_maps() const;
  PackedMaps normal_maps() const;
};

namespace {

struct Constrained {
  std::vector<Index> points;
  Points targets;
};

Constrained constrained_points(const std::vector<Handle>& handles) {
  Constrained all;
  for (const Handle& handle : handles) {
    all.points.insert(all.points.end(), handle.points.begin(), handle.points.end());
  }
  all.targets.resize(3, static_cast<Index>(all.points.size()));
  Index at = 0;
  for (const Handle& handle : handles) {
    all.targets.middleCols(at, handle.targets.cols()) = handle.targets;
    at += static_cast<Index>(handle.targets.cols());
  }
  return all;
}

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

Status EmbeddedGraph::Impl::set_up(const EmbeddedGraph& self) {
  const std::vector<bool> frozen = frozen_nodes(graph, self.fixed_points());
  Pose start = pose;
  for (Index j = 0; j < graph.size(); ++j) {
    if (frozen[j]) start.col(j).setZero();
  }
  const Constrained constrained = constrained_points(self.handles());
  Status status = solver.set_up(graph, frozen, graph.scaled(self.shape().points()(Eigen::all, constrained.points)),
                                rows_of(graph.influences, constrained.points),
                                {weights(), options.solver, options.exact_handles}, start);
  if (!status.ok()) return status;
  pose = std::move(start);
  grab_changed = false;
  targets_changed = true;
  iteration = 0;
  return {};
}

std::vector<Turn> EmbeddedGraph::Impl::turns(const std::vector<Handle>& handles) {
  std::vector<Turn> result;
  Index at = 0;
  for (const Handle& handle : handles) {
    Turn turn;
    for (Index i = 0; i < handle.rest.cols(); ++i) turn.constraints.push_back(at++);
    const auto before = applied.try_emplace(handle.id, Motion{}).first;
    if (handle.motion) turn.rotation = turn_between(before->second, *handle.motion);
    before->second = handle.motion;
    if (!handle.motion && handle.targets == handle.rest) before->second = Motion{};
    result.push_back(std::move(turn));
  }
  return result;
}

void EmbeddedGraph::Impl::take_targets(const EmbeddedGraph& self) {
  const Constrained constrained = constrained_points(self.handles());
  solver.set_targets(graph.scaled(constrained.targets), turns(self.handles()));
  solver.store(pose);
  targets_changed = false;
}

embedded::Terms EmbeddedGraph::Impl::terms(const EmbeddedGraph& self) const {
  if (!grab_changed && !targets_changed) return solver.terms();
  const Constrained constrained = constrained_points(self.handles());
  GraphEnergy energy;
  const Points rest = graph.scaled(self.shape().points()(Eigen::all, constrained.points));
  energy.set_up(graph, std::vector<bool>(graph.size(), false), rest, rows_of(graph.influences, constrained.points),
                weights());
  energy.constraints().set_targets(graph.scaled(constrained.targets) - rest);
  const embedded::Vector x = embedded::unknowns_of(pose);
  energy.evaluate(x);
  embedded::Terms terms = energy.terms();
  terms.barrier = embedded::barrier::sum(energy, x);
  return terms;
}

PackedMaps EmbeddedGraph::Impl::position_maps() const {
  PackedMaps maps(12, graph.size());
  for (Index j = 0; j < graph.size(); ++j) {
    const Eigen::Matrix3d u = embedded::gradient_of(pose, j);
    const Eigen::Vector3d t = graph.length_unit * embedded::translation_of(pose, j);
    maps.col(j) = embedded::pack_map(u, t - u * (graph.nodes.col(j) - graph.origin));
  }
  return maps;
}

PackedMaps EmbeddedGraph::Impl::normal_maps() const {
  // Eq. 3 with cofactors in the place of the inverse transpose: defined for every R.
  PackedMaps maps(12, graph.size());
  for (Index j = 0; j < graph.size(); ++j) {
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + embedded::gradient_of(pose, j);
    maps.col(j) = embedded::pack_map(embedded::cofactors(r) - Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
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

void EmbeddedGraph::constraints_changed() { impl_->grab_changed = true; }
void EmbeddedGraph::targets_changed() { impl_->targets_changed = true; }

void EmbeddedGraph::do_reset() {
  impl_->pose.setZero();
  impl_->applied.clear();
  impl_->grab_changed = true;
}

Result<StepReport> EmbeddedGraph::do_step(double tolerance) {
  if (impl_->grab_changed) {
    if (Status s = impl_->set_up(*this); !s.ok()) return s;
  }
  if (impl_->targets_changed) impl_->take_targets(*this);
  const auto outcome = impl_->solver.step(tolerance);
  if (!outcome.ok()) return outcome.status();
  impl_->solver.store(impl_->pose);
  if (outcome->accepted) ++impl_->iteration;
  return StepReport{impl_->iteration, impl_->solver.terms().total(impl_->weights()), outcome->accepted,
                    outcome->converged};
}

Energy EmbeddedGraph::energy() const {
  const embedded::Weights w = impl_->weights();
  const embedded::Terms terms = impl_->terms(*this);
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
  embedded::carry(impl_->position_maps(), impl_->graph.influences, shape().points(), impl_->graph.origin, out);
  return out;
}

Points EmbeddedGraph::point_normals() const {
  Points out;
  embedded::carry(impl_->normal_maps(), impl_->graph.influences, impl_->rest_normals, Eigen::Vector3d::Zero(), out);
  for (Index i = 0; i < out.cols(); ++i) {
    const double length = out.col(i).norm();
    if (length > 0.0) out.col(i) /= length;
  }
  return out;
}

Result<Points> EmbeddedGraph::transform_points(const Points& points) const {
  Points out;
  embedded::carry(impl_->position_maps(), compute_influences(shape(), impl_->graph, points), points,
                  impl_->graph.origin, out);
  return out;
}

Result<Index> EmbeddedGraph::refine(Index max_nodes) {
  if (max_nodes < 1) {
    return Status(ErrorCode::invalid_option,
                  "refine: maxNodes is " + std::to_string(max_nodes) + "; expected at least 1");
  }
  if (impl_->grab_changed || impl_->targets_changed) return Index{0};  // nothing solved: no terms to go by
  const Points fresh = embedded::nodes_to_add(shape(), impl_->graph, impl_->solver, max_nodes);
  if (fresh.cols() == 0) return Index{0};
  Points nodes(3, impl_->graph.size() + fresh.cols());
  nodes << impl_->graph.nodes, fresh;
  DeformationGraph refined = build_graph(shape(), std::move(nodes), impl_->options);
  impl_->pose = embedded::inherited_pose(shape(), impl_->graph, impl_->pose, refined);
  impl_->graph = std::move(refined);
  impl_->grab_changed = true;
  return static_cast<Index>(fresh.cols());
}

State EmbeddedGraph::save() const {
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
  save_handles(state);
  return state;
}

Status EmbeddedGraph::restore(const State& state) {
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
  impl_->grab_changed = true;
  impl_->applied.clear();
  for (const Handle& handle : handles()) impl_->applied[handle.id] = std::nullopt;
  return restore_handles(state);
}

}  // namespace pliant
