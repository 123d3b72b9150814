// Shapes: RawShape and RawShapeReport.
#include <limits>
#include <span>

#include <emscripten/bind.h>

#include "bound_shape.h"
#include "pliant/geometry/closest_rotation.h"
#include "pliant/geometry/measure.h"

namespace pliant::bindings {

StatusValue BoundShape::build(const Scratch& scratch, int dimension) {
  const std::vector<std::int32_t>& ids = scratch.integers();
  // The same bits: an id below zero becomes one far out of range, which the door refuses.
  const std::span<const std::uint32_t> triangles(reinterpret_cast<const std::uint32_t*>(ids.data()), ids.size());
  auto shape = Shape::create(scratch.doubles(), triangles, dimension);
  if (shape.ok()) shape_ = *shape;
  return to_value(shape.status());
}

double BoundShape::volume() const {
  return enclosed_volume(*shape_).value_or(std::numeric_limits<double>::quiet_NaN());
}

emscripten::val BoundShape::patch(const Scratch& scratch, double radius) {
  if (!patches_) patches_ = std::make_unique<Patches>(*shape_);
  const std::size_t count = scratch.integers().size();
  const Eigen::Map<const Points> numbers(scratch.doubles().data(), 3, static_cast<Index>(scratch.doubles().size() / 3));
  std::vector<Spot> spots;
  for (std::size_t s = 0; s < count; ++s) {
    spots.push_back({shape_->point_of_vertex()[scratch.integers()[s]], numbers.col(static_cast<Index>(s))});
  }
  const auto given = numbers.rightCols(numbers.cols() - static_cast<Index>(count));
  const Points moved = given.cols() > 0 ? Points(given(Eigen::all, shape_->vertex_of_point())) : Points();
  vertices_ = shape_->vertices_at(patches_->around(given.cols() > 0 ? moved : shape_->points(), spots, radius));
  return view_of(vertices_);
}

Index BoundShape::find_loose_parts() {
  loose_parts_ = loose_parts(*shape_);
  return static_cast<Index>(loose_parts_.size());
}

emscripten::val BoundShape::loose_part(Index part) {
  vertices_ = shape_->vertices_at(loose_parts_[part].points);
  return view_of(vertices_);
}

emscripten::val BoundShape::beside_loose_part(Index part) {
  vertices_ = shape_->vertices_at(loose_parts_[part].beside);
  return view_of(vertices_);
}

namespace {

/// doubles in: 3 q points and where they go; out: the rotation vector of the fit, its centre, and where that goes.
void fit_rigid(Scratch& scratch) {
  const Index count = static_cast<Index>(scratch.doubles().size() / 6);
  const Eigen::Map<const Points> from(scratch.doubles().data(), 3, count);
  const Eigen::Map<const Points> to(scratch.doubles().data() + 3 * count, 3, count);
  RigidFit fit;
  for (Index i = 0; i < count; ++i) fit.add(from.col(i), to.col(i));
  Eigen::Matrix<double, 3, 3> motion;
  motion << rotation_vector_of(fit.motion().rotation), fit.from_center(), fit.to_center();
  scratch.set_doubles({motion.data(), motion.data() + motion.size()});
}

}  // namespace

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
      .function("diagonal", &BoundShape::diagonal)
      .function("volume", &BoundShape::volume)
      .function("patch", &BoundShape::patch)
      .function("findLooseParts", &BoundShape::find_loose_parts)
      .function("loosePart", &BoundShape::loose_part)
      .function("besideLoosePart", &BoundShape::beside_loose_part);

  emscripten::function("fitRigid", &fit_rigid);
}

}  // namespace pliant::bindings
