// The parameters of a pose, relative to a reference curve.
#pragma once

#include <vector>

#include "pliant/curves/plane_curve.h"
#include "pliant/curves/profile.h"

namespace pliant {

/// What key poses store and blend. `turns`: as many as the reference curve has inner nodes.
struct SketchPose {
  double heading = 0.0;                    ///< theta_g of eq. 5, radians
  std::vector<double> turns;               ///< added to the exterior angles, radians
  double length = 1.0;                     ///< target's over reference's, above 0
  Profile twist = Profile::constant(0.0);  ///< radians over s
  Profile scale = Profile::constant(1.0);  ///< of the offset from the joints over s, above 0

  /// Lengths and angles blended linearly, section 6.1. Both poses are of one reference.
  static SketchPose blend(const SketchPose& a, const SketchPose& b, double t);
  /// The pose that changes nothing.
  static SketchPose rest(const PlaneCurve& reference);

  bool bends() const;
  bool twists() const { return !(twist == Profile::constant(0.0)); }
  bool scales() const { return !(scale == Profile::constant(1.0)); }
};

/// The reference curve bent by a part t of a pose (0: as it is), from the same start.
PlaneCurve bent(const PlaneCurve& reference, const SketchPose& pose, double t);

}  // namespace pliant
