#include "pliant/sketch/drawing.h"

#include <utility>

namespace pliant {
namespace {

Polyline points_of(const Profile& profile) {
  Polyline points(2, static_cast<Index>(profile.points().size()));
  Index i = 0;
  for (const auto& [s, value] : profile.points()) points.col(i++) = Eigen::Vector2d(s, value);
  return points;
}

}  // namespace

Result<Profile> profile_through(const Polyline& points, const char* argument) {
  std::vector<Profile::Point> pairs;
  for (const auto& point : points.colwise()) pairs.emplace_back(point.x(), point.y());
  return Profile::create(pairs, argument);
}

void exchange(NamedFields& fields, Drawing& drawing) {
  fields("eye", drawing.camera.eye);
  fields("target", drawing.camera.target);
  fields("up", drawing.camera.up);
  fields("fovY", drawing.camera.fov_y);
  fields("orthographicHeight", drawing.camera.orthographic_height);
  fields("width", drawing.camera.width);
  fields("height", drawing.camera.height);
  fields("reference", drawing.reference);
  fields("hold", drawing.options.hold, {"larger", "start", "end"});
  fields("smooth", drawing.options.smooth);
  fields("partitions", drawing.options.partitions);
  if (fields.gives("mirrorNormal")) {
    Plane& plane = drawing.options.mirror.emplace();
    fields("mirrorPoint", plane.point);
    fields("mirrorNormal", plane.normal);
  }
  fields("labels", drawing.options.labels);
}

void exchange(NamedFields& fields, PoseNumbers& pose) {
  fields("heading", pose.heading);
  fields("turns", pose.turns);
  fields("length", pose.length);
  fields("twist", pose.twist);
  fields("scale", pose.scale);
}

Result<SketchPose> read_pose(const NamedValues& given) {
  PoseNumbers numbers;
  if (Status s = read(given, numbers); !s.ok()) return s;
  if (given.size() < 5) return Status(ErrorCode::invalid_option, "pose lacks a field; expected those of pose()");
  Result<Profile> twist = profile_through(numbers.twist, "pose.twist");
  if (!twist.ok()) return twist.status();
  Result<Profile> scale = profile_through(numbers.scale, "pose.scale");
  if (!scale.ok()) return scale.status();
  return SketchPose{numbers.heading, std::move(numbers.turns), numbers.length, std::move(*twist), std::move(*scale)};
}

NamedValues named_pose(const SketchPose& pose) {
  return named(PoseNumbers{pose.heading, pose.length, pose.turns, points_of(pose.twist), points_of(pose.scale)});
}

}  // namespace pliant
