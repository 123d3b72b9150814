// Normals of triangles and points, at rest or deformed.
#pragma once

#include "pliant/core/types.h"

namespace pliant {

/// Cross products of the triangles' edges: twice the area long, 3 x m.
Points triangle_area_vectors(const Points& points, const Triangles& triangles);

/// Unit normals of the points, the normalised sum of the area vectors around them; zero where there
/// is no triangle or the sum cancels, 3 x p.
Points point_normals(const Points& points, const Triangles& triangles);

}  // namespace pliant
