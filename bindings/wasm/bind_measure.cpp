// Quality measures: measureQuality and RawQuality.
#include <limits>

#include <Eigen/Core>
#include <emscripten/bind.h>

#include "bound_shape.h"
#include "pliant/geometry/measure.h"

namespace pliant::bindings {
namespace {

/// RawQuality: NaN stands for a measure that is not defined.
struct QualityValue {
  double stretch_mean, stretch_p95, stretch_max, shear, volume, area;
  double folds, intersections, roughness_rest, roughness;
};

/// scratch.doubles: 3 n deformed positions of the input's vertices; those at one point agree.
QualityValue measure(const BoundShape& bound, const Scratch& scratch, bool with_intersections) {
  const Shape& shape = *bound.get();
  const Eigen::Map<const Points> vertices(scratch.doubles().data(), 3, shape.input_size());
  const Points points = vertices(Eigen::all, shape.vertex_of_point());
  const Quality q = measure_quality(shape, points, with_intersections);
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  return {q.stretch_mean,
          q.stretch_p95,
          q.stretch_max,
          q.shear,
          q.volume.value_or(undefined),
          q.area.value_or(undefined),
          static_cast<double>(q.folds),
          static_cast<double>(q.intersections),
          q.roughness_rest,
          q.roughness};
}

}  // namespace

EMSCRIPTEN_BINDINGS(pliant_measure) {
  emscripten::value_object<QualityValue>("RawQuality")
      .field("stretchMean", &QualityValue::stretch_mean)
      .field("stretchP95", &QualityValue::stretch_p95)
      .field("stretchMax", &QualityValue::stretch_max)
      .field("shear", &QualityValue::shear)
      .field("volume", &QualityValue::volume)
      .field("area", &QualityValue::area)
      .field("folds", &QualityValue::folds)
      .field("intersections", &QualityValue::intersections)
      .field("roughnessRest", &QualityValue::roughness_rest)
      .field("roughness", &QualityValue::roughness);

  emscripten::function("measureQuality", &measure);
}

}  // namespace pliant::bindings
