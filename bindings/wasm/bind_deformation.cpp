// What deformers and sketches have in common: RawDeformation.
#include <utility>

#include <Eigen/Core>
#include <emscripten/bind.h>

#include "bound_deformation.h"

namespace pliant::bindings {

using emscripten::val;

val BoundDeformation::positions() {
  floats_ = deformation().positions().cast<float>();
  return view_of(floats_);
}

val BoundDeformation::positions64() {
  doubles_ = deformation().positions();
  return view_of(doubles_);
}

val BoundDeformation::normals() {
  floats_ = deformation().normals().cast<float>();
  return view_of(floats_);
}

PointsValue BoundDeformation::transform_points(const Scratch& scratch) {
  const std::vector<double>& given = scratch.doubles();
  return given_out(
      deformation().transform_points(Eigen::Map<const Points>(given.data(), 3, static_cast<Index>(given.size() / 3))));
}

PointsValue BoundDeformation::transform_normals(const Scratch& scratch) {
  const std::vector<double>& given = scratch.doubles();
  const Eigen::Map<const Points> both(given.data(), 3, static_cast<Index>(given.size() / 3));
  return given_out(deformation().transform_normals(both.leftCols(both.cols() / 2), both.rightCols(both.cols() / 2)));
}

PointsValue BoundDeformation::given_out(Result<Points> points) {
  if (!points.ok()) return {to_value(points.status())};
  doubles_ = std::move(*points);
  return {to_value(Status()), view_of(doubles_)};
}

EMSCRIPTEN_BINDINGS(pliant_deformation) {
  emscripten::value_object<PointsValue>("RawPoints")
      .field("status", &PointsValue::status)
      .field("points", &PointsValue::points);

  emscripten::class_<BoundDeformation>("Deformation")
      .function("positions", &BoundDeformation::positions)
      .function("positions64", &BoundDeformation::positions64)
      .function("normals", &BoundDeformation::normals)
      .function("transformPoints", &BoundDeformation::transform_points)
      .function("transformNormals", &BoundDeformation::transform_normals)
      .function("reset", &BoundDeformation::reset)
      .function("save", &BoundDeformation::save)
      .function("restore", &BoundDeformation::restore);
}

}  // namespace pliant::bindings
