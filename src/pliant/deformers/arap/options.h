// Options of ARAP.
#pragma once

#include <optional>

#include "pliant/core/named_values.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// What one rotation has to fit.
enum class ArapEnergy {
  /// The edges that leave a point, weights max(0, (cot a + cot b) / 2) (Sorkine & Alexa 2007, eq.
  /// 3).
  spokes,
  /// All edges of the triangles around a point, half a cotangent for each of an edge's triangles,
  /// as
  /// it is (Chao, Pinkall, Sanan, Schroeder: A Simple Geometric Model for Elastic Deformations,
  /// 2010).
  spokes_and_rims,
};

struct ArapOptions {
  ArapEnergy energy = ArapEnergy::spokes;
  /// Empty: handles meet their targets exactly. A number above 0: they are soft, the energy gains
  /// constraint_weight times the sum of squared distances from the targets. Fixed points are exact
  /// in any case.
  std::optional<double> constraint_weight = {};
  /// Length, as a part of the square root A of the surface's area, below which bending is kept
  /// away: 0 is plain ARAP, which grows a spike under a handle of a single vertex; 0.05 to 0.2 give
  /// a smooth hill. The energy gains (smoothness A)^2 sum_i |delta'_i - R_i delta_i|^2 / a_i over
  /// inner points, with delta the cotangent Laplacian and a_i a third of the area around; handles
  /// stay exact.
  double smoothness = 0.0;

  /// Errors: invalid_option, naming the option, its value and what was expected.
  Status validate() const;
};

void exchange(NamedFields& fields, ArapOptions& options);

}  // namespace pliant
