// Quality measures of a deformation, one meaning everywhere.
#pragma once

#include <optional>

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"

namespace pliant {

struct Quality {
  double stretch_mean = 0.0;  ///< |l'/l - 1| over the edges
  double stretch_p95 = 0.0;
  double stretch_max = 0.0;
  double shear = 0.0;            ///< mean change of the corner angles, degrees
  std::optional<double> volume;  ///< signed volume ratio; closed shapes only
  std::optional<double> area;    ///< area ratio; shapes with triangles
  Index folds = 0;               ///< edges whose two normals newly have a dot product below -0.5
  Index intersections = 0;       ///< pairs of triangles that newly intersect
  double roughness_rest = 0.0;   ///< RMS of the normal Laplacian over the diagonal, at rest ...
  double roughness = 0.0;        ///< ... and deformed
};

/// Compares a shape with its deformed points (3 x p, one per point of the shape, finite).
/// `with_intersections` false skips the only measure that needs a tree over the triangles.
Quality measure_quality(const Shape& rest, const Points& deformed, bool with_intersections = true);

}  // namespace pliant
