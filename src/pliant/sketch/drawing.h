// What a sketch is made from and posed by, under the names that come from outside.
#pragma once

#include "pliant/core/named_values.h"
#include "pliant/sketch/sketch.h"

namespace pliant {

/// A reference stroke, the camera it is seen through, and what chooses the region.
struct Drawing {
  CameraOptions camera;
  Stroke reference;
  SketchOptions options;
};

/// Fields: eye, target, up, fovY, orthographicHeight, width, height; reference; hold, smooth, partitions;
/// mirrorPoint and mirrorNormal, where it is mirrored; labels.
void exchange(NamedFields& fields, Drawing& drawing);

/// A pose with its profiles as points (s, F(s)), one a column, that nobody has checked yet.
struct PoseNumbers {
  double heading = 0.0, length = 1.0;
  std::vector<double> turns;
  Polyline twist, scale;
};

void exchange(NamedFields& fields, PoseNumbers& pose);

/// Errors: invalid_option (a field is missing, a profile that is none), naming "pose.twist".
Result<SketchPose> read_pose(const NamedValues& given);
NamedValues named_pose(const SketchPose& pose);

/// Errors: those of Profile::create.
Result<Profile> profile_through(const Polyline& points, const char* argument);

}  // namespace pliant
