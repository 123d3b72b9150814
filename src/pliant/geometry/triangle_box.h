// Whether a triangle meets a box.
#pragma once

#include "pliant/core/types.h"

namespace pliant {

/// An axis-parallel box by its centre and half its sides; sides may be zero (a face of a box).
struct CenteredBox {
  Eigen::Vector3d center;
  Eigen::Vector3d half;
};

/// Whether the triangle with these corners (columns) and the box have a point in common; touching
/// counts. Triangles may be degenerate: a segment, a point. Source: Akenine-Moeller, Fast 3D
/// triangle-box overlap testing, 2001 (separating axes).
bool triangle_meets_box(const Eigen::Matrix3d& corners, const CenteredBox& box);

}  // namespace pliant
