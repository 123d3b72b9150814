#include "pliant/deformers/registry.h"

#include <string>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/edge_material/deformer.h"
#include "pliant/deformers/embedded_graph/deformer.h"
#include "pliant/deformers/rigid_cells/deformer.h"

namespace pliant {
namespace {

template <class D, class Options>
Result<std::unique_ptr<Deformer>> build(std::shared_ptr<const Shape> shape, const NamedValues& given) {
  Options options;
  if (Status s = read(given, options); !s.ok()) return s;
  Result<std::unique_ptr<D>> built = D::create(std::move(shape), options);
  if (!built.ok()) return built.status();
  return std::unique_ptr<Deformer>(std::move(*built));
}

constexpr RegisteredMethod kMethods[] = {
    {"embedded-graph", &build<EmbeddedGraph, EmbeddedGraphOptions>},
    {"edge-material", &build<EdgeMaterial, EdgeMaterialOptions>},
    {"arap", &build<Arap, ArapOptions>},
    {"rigid-cells", &build<RigidCells, RigidCellsOptions>},
};

}  // namespace

std::span<const RegisteredMethod> registered_methods() { return kMethods; }

Result<std::unique_ptr<Deformer>> build_deformer(std::string_view method, std::shared_ptr<const Shape> shape,
                                                 const NamedValues& options) {
  std::string names;
  for (const RegisteredMethod& known : kMethods) {
    if (method == known.name) return known.build(std::move(shape), options);
    names += message({names.empty() ? "" : ", ", known.name});
  }
  return Status(ErrorCode::invalid_option, message({"method is \"", method, "\"; expected ", names}));
}

}  // namespace pliant
