#include "pliant/deformers/embedded_graph/options.h"

#include <cmath>
#include <string>

#include "pliant/core/message.h"

namespace pliant {
namespace {

constexpr Index kDefaultNodes = 250;

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

Status check_weight(const char* name, double value, bool zero_allowed) {
  if (std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0))) return {};
  return invalid(
      message({name, " is ", value, "; expected a finite number ", zero_allowed ? "of at least 0" : "above 0"}));
}

Status check_count(const char* name, Index value, Index most, const char* of_what) {
  if (value >= 1 && value <= most) return {};
  return invalid(message({name, " is ", value, "; expected 1 to ", most, ", the number of ", of_what}));
}

Status check_cut(const Cut& cut, const Shape& shape) {
  std::vector<unsigned char> side(shape.points().cols(), 0);
  for (const auto* list : {&cut.a, &cut.b}) {
    const unsigned char mark = list == &cut.a ? 1 : 2;
    if (list->empty()) return invalid("cuts holds an empty selection; expected two sets of vertices");
    for (Index vertex : *list) {
      if (vertex < 0 || vertex >= shape.input_size()) {
        return invalid(message({"cuts holds vertex ", vertex, "; expected 0 to ", shape.input_size() - 1}));
      }
      unsigned char& at = side[shape.point_of_vertex()[vertex]];
      if (at != 0 && at != mark) {
        return invalid(
            message({"cuts holds vertex ", vertex, " on both sides of a pair; expected disjoint selections"}));
      }
      at = mark;
    }
  }
  return {};
}

}  // namespace

Status EmbeddedGraphOptions::validate(const Shape& shape) const {
  const Index points = static_cast<Index>(shape.points().cols());
  if (sampling == NodeSampling::nodes) {
    if (node_count != 0) return invalid("nodes and nodeCount are both given; expected one of them");
    if (nodes.cols() == 0) return invalid("nodes is empty; expected at least one position");
    if (!nodes.allFinite()) return invalid("nodes holds a number that is not finite");
  } else if (node_count != 0) {
    if (Status s = check_count("nodeCount", node_count, points, "points of the shape"); !s.ok()) return s;
  }
  if (sampling == NodeSampling::simplify && shape.triangles().cols() == 0) {
    return invalid("sampling is \"simplify\", but the shape has no triangles; expected \"surface\"");
  }
  if (neighbours != 0) {
    if (Status s = check_count("neighbours", neighbours, wanted_nodes(shape), "nodes"); !s.ok()) return s;
  }
  if (Status s = check_weight("rotationWeight", rotation_weight, false); !s.ok()) return s;
  if (Status s = check_weight("regularizationWeight", regularization_weight, false); !s.ok()) return s;
  if (Status s = check_weight("constraintWeight", constraint_weight, false); !s.ok()) return s;
  for (const Cut& cut : cuts) {
    if (Status s = check_cut(cut, shape); !s.ok()) return s;
  }
  return {};
}

Index EmbeddedGraphOptions::wanted_nodes(const Shape& shape) const {
  if (sampling == NodeSampling::nodes) return static_cast<Index>(nodes.cols());
  return node_count != 0 ? node_count : std::min(kDefaultNodes, static_cast<Index>(shape.points().cols()));
}

void exchange(NamedFields& fields, EmbeddedGraphOptions& options) {
  if (fields.gives("nodes")) options.sampling = NodeSampling::nodes;
  if (options.sampling == NodeSampling::nodes) {
    fields("nodes", options.nodes);
  } else {
    fields("nodeCount", options.node_count);
    fields("sampling", options.sampling, {"surface", "simplify"});
  }
  fields("neighbours", options.neighbours);
  fields("rotationWeight", options.rotation_weight);
  fields("regularizationWeight", options.regularization_weight);
  fields("constraintWeight", options.constraint_weight);
  fields("solver", options.solver, {"auto", "gauss-newton"});
  fields("exactHandles", options.exact_handles);
  std::vector<std::vector<Index>> sides;
  for (const Cut& cut : options.cuts) sides.insert(sides.end(), {cut.a, cut.b});
  fields("cuts", sides);
  options.cuts.clear();
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) options.cuts.push_back({sides[i], sides[i + 1]});
  fields("refine", options.refine);
  fields("seed", options.seed);
}

}  // namespace pliant
