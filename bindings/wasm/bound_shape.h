// RawShape of bindings/js/boundary/raw.ts: a shared, immutable Shape that JavaScript holds by one object.
#pragma once

#include <memory>

#include "pliant/geometry/shape.h"
#include "scratch.h"
#include "status_value.h"

namespace pliant::bindings {

/// Empty until `build` succeeds; the other calls need a shape.
class BoundShape {
 public:
  /// doubles: dimension * n coordinates; integers: 3 * m vertex ids (may be empty).
  StatusValue build(const Scratch& scratch, int dimension);
  ShapeReport report() const { return shape_->report(); }
  double diagonal() const { return shape_->diagonal(); }

  const std::shared_ptr<const Shape>& get() const { return shape_; }

 private:
  std::shared_ptr<const Shape> shape_;
};

}  // namespace pliant::bindings
