// RawDeformation of bindings/js/boundary/raw.ts: what deformers and sketches have in common.
#pragma once

#include "bound_state.h"
#include "pliant/solve/deformation.h"
#include "status_value.h"

namespace pliant::bindings {

struct PointsValue {
  StatusValue status;
  emscripten::val points = emscripten::val::null();
};

/// The views it hands out are of its own buffers, valid until the next call.
class BoundDeformation {
 public:
  virtual ~BoundDeformation() = default;

  emscripten::val positions();
  emscripten::val positions64();
  emscripten::val normals();
  /// scratch.doubles: 3 q.
  PointsValue transform_points(const Scratch& scratch);
  /// scratch.doubles: 3 q points, then their normals.
  PointsValue transform_normals(const Scratch& scratch);
  void reset() { deformation().reset(); }
  void save(BoundState& bound) { bound.state = deformation().save(); }
  StatusValue restore(const BoundState& bound) { return to_value(deformation().restore(bound.state)); }

 protected:
  virtual Deformation& deformation() = 0;

 private:
  PointsValue given_out(Result<Points> points);

  Eigen::Matrix<float, 3, Eigen::Dynamic> floats_;
  Points doubles_;
};

}  // namespace pliant::bindings
