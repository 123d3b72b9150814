// Many closest rotations at once.
#pragma once

#include "pliant/solve/local_model.h"

namespace pliant::arap {

/// rotations.col(i) <- the rotation R with the largest tr(R' S_i), S_i = covariances.col(i): in one
/// pass, without a start value. `planar`: turns about z only, and only the upper left 2 x 2 of S
/// counts. S = 0 gives the identity.
///
/// Markley: Attitude Determination Using Vector Observations: A Fast Optimal Matrix Algorithm,
/// J. Astronautical Sciences 41, 1993. Where two rotations are nearly as good it loses digits; an
/// SVD takes over there.
void fit_rotations(const Rotations& covariances, bool planar, Rotations& rotations);

}  // namespace pliant::arap
