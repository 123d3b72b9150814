// Shapes: RawShape and RawShapeReport.
#include <span>

#include <emscripten/bind.h>

#include "bound_shape.h"

namespace pliant::bindings {

StatusValue BoundShape::build(const Scratch& scratch, int dimension) {
  const std::vector<std::int32_t>& ids = scratch.integers();
  // The same bits: an id below zero becomes one far out of range, which the door refuses.
  const std::span<const std::uint32_t> triangles(reinterpret_cast<const std::uint32_t*>(ids.data()), ids.size());
  auto shape = Shape::create(scratch.doubles(), triangles, dimension);
  if (shape.ok()) shape_ = *shape;
  return to_value(shape.status());
}

EMSCRIPTEN_BINDINGS(pliant_shape) {
  emscripten::value_object<ShapeReport>("RawShapeReport")
      .field("vertices", &ShapeReport::vertices)
      .field("triangles", &ShapeReport::triangles)
      .field("components", &ShapeReport::components)
      .field("boundaryEdges", &ShapeReport::boundary_edges)
      .field("nonManifoldEdges", &ShapeReport::non_manifold_edges)
      .field("degenerateTriangles", &ShapeReport::degenerate_triangles)
      .field("weldedVertices", &ShapeReport::welded_vertices);

  emscripten::class_<BoundShape>("Shape")
      .constructor<>()
      .function("build", &BoundShape::build)
      .function("report", &BoundShape::report)
      .function("diagonal", &BoundShape::diagonal);
}

}  // namespace pliant::bindings
