#include "support/methods.h"

#include <doctest/doctest.h>

#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/edge_material/deformer.h"
#include "pliant/deformers/embedded_graph/deformer.h"

namespace pliant::test {
namespace {

Method embedded_graph(const char* name, EmbeddedGraphOptions options) {
  options.node_count = 60;
  // Eq. 5 is not isotropic: 2 % for other angles than quarter turns.
  constexpr double kIsotropy = 0.02;
  return {name,
          [options](auto shape) -> std::unique_ptr<Deformer> {
            auto deformer = EmbeddedGraph::create(std::move(shape), options);
            REQUIRE(deformer.ok());
            return std::move(*deformer);
          },
          kIsotropy, options.exact_handles};
}

/// Sets each of these options on a living deformer of class D.
template <class D, class Options>
std::vector<std::function<void(Deformer&)>> setters(const std::vector<Options>& all) {
  std::vector<std::function<void(Deformer&)>> setters;
  for (const Options& options : all) {
    setters.push_back([options](Deformer& deformer) { REQUIRE(static_cast<D&>(deformer).set_options(options).ok()); });
  }
  return setters;
}

Method arap(const char* name, const ArapOptions& options) {
  Method method{name, [options](auto shape) -> std::unique_ptr<Deformer> {
                  auto deformer = Arap::create(std::move(shape), options);
                  REQUIRE(deformer.ok());
                  return std::move(*deformer);
                }};
  std::vector<ArapOptions> others = {options, {.energy = ArapEnergy::spokes_and_rims}, {.smoothness = 0.2}};
  others.push_back({.constraint_weight = 30.0, .smoothness = 0.05});
  others.push_back({.constraint_weight = 10.0});
  method.live_options = setters<Arap>(others);
  return method;
}

Method edge_material(const char* name, const EdgeMaterialOptions& options) {
  Method method{name, [options](auto shape) -> std::unique_ptr<Deformer> {
                  auto deformer = EdgeMaterial::create(std::move(shape), options);
                  REQUIRE(deformer.ok());
                  return std::move(*deformer);
                }};
  std::vector<EdgeMaterialOptions> others(4, options);
  others[1].lambda = 0.05;
  others[2].p_bend = 0.5;
  others[3].field = {.kind = DirectionField::Kind::axis, .axis = {0.2, 0.0, 1.0}};
  method.live_options = setters<EdgeMaterial>(others);
  return method;
}

}  // namespace

std::vector<Method> methods() {
  return {
      embedded_graph("embedded-graph", {}),
      embedded_graph("embedded-graph, gauss-newton", {.solver = EmbeddedGraphSolver::gauss_newton}),
      arap("arap", {}),
      arap("arap, rims", {.energy = ArapEnergy::spokes_and_rims}),
      arap("arap, soft", {.constraint_weight = 100.0}),
      arap("arap, smooth", {.smoothness = 0.1}),
      // The paper's lambda: the diagonal in `stretch` is that of the bounding box, which turning
      // the scene changes.
      edge_material("edge-material", {.lambda = 3e-3}),
      edge_material("edge-material, field", {.lambda = 0.02, .field = {.kind = DirectionField::Kind::curvature_max}}),
  };
}

std::vector<Method> exact_methods() {
  return {
      embedded_graph("embedded-graph, exact", {.exact_handles = true}),
      embedded_graph("embedded-graph, gauss-newton, exact",
                     {.solver = EmbeddedGraphSolver::gauss_newton, .exact_handles = true}),
  };
}

}  // namespace pliant::test
