// Quality measures of a deformation, one meaning everywhere.
#pragma once

#include <optional>

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// All zero, and the ratios empty, for a shape without triangles.
struct Quality {
  double stretch_mean = 0.0;  ///< |l'/l - 1| over the edges
  double stretch_p95 = 0.0;   ///< the 95th percentile, linear between two values
  double stretch_max = 0.0;
  double shear = 0.0;  ///< mean change of the corner angles, degrees
  /// Signed volume ratio. Only where the surface bounds something: every edge is walked as often
  /// one way as the other, and the volume at rest is not zero.
  std::optional<double> volume;
  std::optional<double> area;  ///< area ratio; shapes with area at rest
  /// Edges of two triangles whose normals newly have a dot product below -0.5.
  Index folds = 0;
  /// Pairs of triangles without a common corner that newly intersect; contacts do not count
  /// (triangle_crossing.h).
  Index intersections = 0;
  /// RMS over the points of the normal part of (mean of the neighbours - point), over the diagonal
  /// of the rest shape: at rest ...
  double roughness_rest = 0.0;
  double roughness = 0.0;  ///< ... and deformed
};

/// Signed volume of what a surface bounds, positive where its triangles look outwards. Only where every edge is walked
/// as often one way as the other, and the volume is not zero.
std::optional<double> enclosed_volume(const Shape& shape);

/// Compares a shape with its deformed points (3 x p, one per point of the shape, finite).
/// `with_intersections` false skips the only measure that needs a tree over the triangles.
Quality measure_quality(const Shape& rest, const Points& deformed, bool with_intersections = true);

}  // namespace pliant
