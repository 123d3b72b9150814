// Where the rays through pixels meet a mesh.
#pragma once

#include <vector>

#include "pliant/core/types.h"
#include "pliant/curves/plane_curve.h"
#include "pliant/sketch/camera.h"

namespace pliant {

struct Hit {
  double depth;    ///< view coordinates
  Index triangle;  ///< the first of those met at that depth
};

/// For every pixel the hits of its ray, nearest first; hits at one depth (to 1e-7 of it) are one.
/// view: the points in view coordinates, 3 x p. One pass over the triangles for all pixels;
/// triangles that reach behind the eye are left out.
std::vector<std::vector<Hit>> hits_through(const Camera& camera, const Points& view, const Triangles& triangles,
                                           const Polyline& pixels);

}  // namespace pliant
