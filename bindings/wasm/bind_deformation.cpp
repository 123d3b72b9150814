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
  Result<Points> carried =
      deformation().transform_points(Eigen::Map<const Points>(given.data(), 3, static_cast<Index>(given.size() / 3)));
  if (!carried.ok()) return {to_value(carried.status())};
  doubles_ = std::move(*carried);
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
      .function("reset", &BoundDeformation::reset)
      .function("save", &BoundDeformation::save)
      .function("restore", &BoundDeformation::restore);
}

}  // namespace pliant::bindings
