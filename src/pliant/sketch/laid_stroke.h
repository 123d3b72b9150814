// A reference stroke laid into space, section 4.1 of Kho and Garland.
#pragma once

#include <vector>

#include "pliant/core/status.h"
#include "pliant/curves/plane_curve.h"
#include "pliant/sketch/camera.h"
#include "pliant/sketch/hits.h"

namespace pliant {

/// A shape seen through a camera.
struct SeenShape {
  Camera camera;
  Points view;  ///< its points in view coordinates, 3 x p
  const Triangles& triangles;
};

struct LaidStroke {
  Polyline pixels;                     ///< filtered, of equal steps
  std::vector<std::vector<Hit>> hits;  ///< of every pixel
  double depth = 0.0;                  ///< of the plane parallel to the image
  PlaneCurve curve;                    ///< on that plane, x and y of view coordinates
};

/// The plane goes through the first hit of the first pixel; where that misses the shape, through
/// that of the next pixel along the stroke that meets it; where none does, through the centroid.
/// Errors: invalid_option (the plane is behind the eye, or the shape too far away for its size).
Result<LaidStroke> lay_stroke(const SeenShape& shape, const Polyline& pixels);

/// The stroke as if it had been drawn from its end on. Errors: those of lay_stroke.
Result<LaidStroke> reversed(const SeenShape& shape, LaidStroke stroke);

}  // namespace pliant
