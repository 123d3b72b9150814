// RawShape of bindings/js/boundary/raw.ts: a shared, immutable Shape that JavaScript holds by one object.
#pragma once

#include <memory>

#include "pliant/geometry/loose_parts.h"
#include "pliant/geometry/patch.h"
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
  /// NaN where the surface bounds nothing.
  double volume() const;
  /// integers: a vertex a spot; doubles: 3 a spot, its centre, and 3 n positions, or none for those at rest. The
  /// vertices of the patch.
  emscripten::val patch(const Scratch& scratch, double radius);
  /// How many there are; the next two give vertices of one of them.
  Index find_loose_parts();
  emscripten::val loose_part(Index part);
  emscripten::val beside_loose_part(Index part);

  const std::shared_ptr<const Shape>& get() const { return shape_; }

 private:
  std::shared_ptr<const Shape> shape_;
  std::unique_ptr<Patches> patches_;  ///< from when they are first asked for
  std::vector<LoosePart> loose_parts_;
  std::vector<Index> vertices_;  ///< what was returned a view of
};

}  // namespace pliant::bindings
