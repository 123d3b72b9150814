// The limb that a place belongs to, as a stroke along it: for a gesture that begins on a limb and
// leaves it at once.
#pragma once

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"
#include "pliant/sketch/camera.h"
#include "pliant/sketch/stroke.h"

namespace pliant {

/// A reference stroke through the middle of the limb under a pixel, from where it leaves the body to
/// the place under the pixel. Around that place distances along edges grow; the limb ends where the
/// line of equal distance is shortest for the area it encloses (least length^2 / area), before it
/// grows into the body. Linear in the shape but for a sort.
/// Errors: invalid_option (no pixel; one that meets nothing, or no limb: nothing at least as long as
/// thick, less than half of the component; a limb seen from its end).
Result<Stroke> stroke_along_limb(const Shape& shape, const Camera& camera, const Eigen::Vector2d& pixel);

}  // namespace pliant
