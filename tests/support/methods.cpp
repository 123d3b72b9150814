#include "support/methods.h"

#include <doctest/doctest.h>

#include "pliant/deformers/embedded_graph/deformer.h"

namespace pliant::test {
namespace {

std::unique_ptr<Deformer> embedded_graph(std::shared_ptr<const Shape> shape,
                                         EmbeddedGraphSolver solver, NodeSampling sampling) {
  EmbeddedGraphOptions options;
  options.node_count = 60;
  options.solver = solver;
  options.sampling = sampling;
  auto deformer = EmbeddedGraph::create(std::move(shape), options);
  REQUIRE(deformer.ok());
  return std::move(*deformer);
}

}  // namespace

std::vector<Method> methods() {
  // Eq. 5 of the embedded graph is not isotropic: 2 % for other angles than quarter turns.
  return {
      {"embedded-graph",
       [](auto shape) {
         return embedded_graph(shape, EmbeddedGraphSolver::automatic, NodeSampling::surface);
       },
       0.02},
      {"embedded-graph, gauss-newton",
       [](auto shape) {
         return embedded_graph(shape, EmbeddedGraphSolver::gauss_newton, NodeSampling::surface);
       },
       0.02},
  };
}

}  // namespace pliant::test
