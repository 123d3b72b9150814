#include "support/methods.h"

#include <doctest/doctest.h>

#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/edge_material/deformer.h"
#include "pliant/deformers/embedded_graph/deformer.h"
#include "pliant/deformers/rigid_cells/deformer.h"

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

Method rigid_cells(const char* name, RigidCellsOptions options) {
  options.resolution = 8;
  Method method{name, [options](auto shape) -> std::unique_ptr<Deformer> {
                  auto deformer = RigidCells::create(std::move(shape), options);
                  REQUIRE(deformer.ok());
                  return std::move(*deformer);
                }};
  std::vector<RigidCellsOptions> others(4, options);
  others[1].transfer = CellTransfer::blend;
  others[2].hold = CellHold::points;
  others[3].stiffness = {{{1, 2, 3}, 4.0}};
  method.live_options = setters<RigidCells>(others);
  return method;
}

Method recorded(Method method, const Eigen::Vector3d& mean, const Eigen::Vector3d& vertex) {
  method.recorded = {mean, vertex};
  return method;
}

}  // namespace

std::vector<Method> methods() {
  return {
      recorded(embedded_graph("embedded-graph", {}), {-0.0634170083706872, 0.046933374322741, 0.0368488480469284},
               {-0.571522656523019, 0.340954191208747, 0.669026764079903}),
      recorded(embedded_graph("embedded-graph, gauss-newton", {.solver = EmbeddedGraphSolver::gauss_newton}),
               {-0.0634090965690702, 0.0469433166846666, 0.0368551560131308},
               {-0.571492835193796, 0.34097085615089, 0.669027950207101}),
      recorded(arap("arap", {}), {-0.0775710606584072, 0.00641576886737877, 0.0461871247264094},
               {-0.620296450486798, 0.217760779697827, 0.730616698831364}),
      recorded(arap("arap, rims", {.energy = ArapEnergy::spokes_and_rims}),
               {-0.0758649168489664, 0.0105050895735654, 0.0430469965260838},
               {-0.619971265166443, 0.226352961653798, 0.738868778105172}),
      recorded(arap("arap, soft", {.constraint_weight = 100.0}),
               {-0.0754760331272869, 0.010772170038707, 0.0428678913935817},
               {-0.625749314677271, 0.243157810504613, 0.682587308396889}),
      recorded(arap("arap, smooth", {.smoothness = 0.1}), {-0.0835857216407971, 0.0249596122150149, 0.0720448911794829},
               {-0.610521763946182, 0.233676160879028, 0.775403292379724}),
      // The paper's lambda: the diagonal in `stretch` is that of the bounding box, which turning
      // the scene changes.
      recorded(edge_material("edge-material", {.lambda = 3e-3}),
               {-0.0830478129167169, 0.033146662270167, 0.132069198797718},
               {-0.548267862240704, 0.259385617800194, 0.993833971554214}),
      recorded(edge_material("edge-material, field",
                             {.lambda = 0.02, .field = {.kind = DirectionField::Kind::curvature_max}}),
               {-0.0806609261996718, 0.0257392411463397, 0.116561130227058},
               {-0.560329254375608, 0.259191211154912, 0.935393981232096}),
      recorded(rigid_cells("rigid-cells", {}), {-0.146444038197735, 0.00892903587449061, 0.0643740861973311},
               {-0.647356978981667, 0.176573836278537, 0.688516991711685}),
      recorded(rigid_cells("rigid-cells, shell, blend", {.interior = false, .transfer = CellTransfer::blend}),
               {-0.11045147070908, 0.0251639798676398, 0.04609186310352},
               {-0.629836488720733, 0.225368960346473, 0.769789452130466}),
      recorded(rigid_cells("rigid-cells, points", {.hold = CellHold::points}),
               {-0.104964810508318, -0.0102599717323697, 0.051243804556837},
               {-0.631092077651231, 0.199119120557384, 0.621420818321966}),
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
