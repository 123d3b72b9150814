// Options of the embedded deformation graph.
#pragma once

#include <cstdint>
#include <vector>

#include "pliant/core/named_values.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// Where the nodes of the graph come from (Sumner 2007, section 3).
enum class NodeSampling {
  surface,   ///< random removal within a radius, spread evenly over the shape
  simplify,  ///< survivors of mesh simplification: nodes are points of the shape
  nodes,     ///< placed by hand: EmbeddedGraphOptions::nodes
};

enum class EmbeddedGraphSolver {
  automatic,     ///< quasi-Newton in the metric of the constant part of the energy; fastest
  gauss_newton,  ///< the paper's (eq. 10-11), damped, with an exact line search; the reference
};

/// Two sets of input vertices that must not influence each other: a hand beside a leg.
struct Cut {
  std::vector<Index> a;
  std::vector<Index> b;
};

struct EmbeddedGraphOptions {
  Index node_count = 0;  ///< 0: 250, or as many as the shape has points
  NodeSampling sampling = NodeSampling::surface;
  Points nodes = {};   ///< 3 x m, for NodeSampling::nodes
  int neighbours = 0;  ///< k of eq. 4; 0: 4, or as many as there are nodes
  double rotation_weight = 1.0;
  double regularization_weight = 10.0;
  double constraint_weight = 100.0;
  EmbeddedGraphSolver solver = EmbeddedGraphSolver::automatic;
  bool exact_handles = false;  ///< targets are met exactly where the graph can meet them
  std::vector<Cut> cuts = {};
  /// `refine()` adds up to half as many nodes where the energy is high.
  bool refine = false;
  std::uint64_t seed = 1;

  /// Errors: invalid_option, naming the option, its value and what was expected.
  Status validate(const Shape& shape) const;
  /// Nodes that are asked for: placed, counted, or the default for a shape.
  Index wanted_nodes(const Shape& shape) const;
};

/// `nodes` stands for `nodeCount` and `sampling`.
void exchange(NamedFields& fields, EmbeddedGraphOptions& options);

}  // namespace pliant
