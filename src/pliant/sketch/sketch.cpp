#include "pliant/sketch/sketch.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/sketch/sketch_model.h"

namespace pliant {
namespace {

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

/// What of the reference an unfinished target has not reached yet, turned to go on from its end.
Stroke continued(const Stroke& target, const Polyline& reference) {
  const double drawn = length_of(target), whole = length_of(reference);
  const Index last = static_cast<Index>(reference.cols()) - 1;
  const Index from = static_cast<Index>(std::ceil(drawn / whole * last));
  if (from >= last) return target;
  // The direction of the last few pixels: single samples are too noisy.
  Index before = static_cast<Index>(target.cols()) - 1;
  const Eigen::Vector2d end = target.col(before);
  while (before > 0 && (end - target.col(before)).norm() < 2 * kMinStrokeSegment) --before;
  const Eigen::Vector2d u = reference.col(from + 1) - reference.col(from);
  const Eigen::Vector2d v = end - target.col(before);
  const double angle = std::atan2(v.y(), v.x()) - std::atan2(u.y(), u.x());
  const Eigen::Rotation2D<double> turn(angle);
  const Eigen::Index kept = target.cols();
  Stroke result(2, kept + last - from);
  result.leftCols(kept) = target;
  for (Index i = from + 1; i <= last; ++i) {
    result.col(kept + i - from - 1) = end + turn * (reference.col(i) - reference.col(from));
  }
  return result;
}

}  // namespace

// -- What it holds.

SketchPose SketchModel::whole_pose() const {
  SketchPose pose = base;
  if (turning == Profile::identity()) return pose;
  const double step = 1.0 / static_cast<double>(curve().size() - 1);
  for (std::size_t i = 0; i < pose.turns.size(); ++i) {
    const double s = step * static_cast<double>(i + 1);
    pose.turns[i] += (turning(s) - s) * step;  // eq. 8, whatever the number of nodes
  }
  return pose;
}

void SketchModel::pose_changed(bool preview) {
  const SketchPose pose = whole_pose();
  for (Limb& limb : limbs) limb.set_pose(pose, preview ? 1e-4 : 1e-8);
  show();
}

void SketchModel::show() {
  const Index points = static_cast<Index>(shape->points().cols());
  world.leftCols(points) = shape->points();
  if (refinement) {
    for (std::size_t i = 0; i < refinement->parents.size(); ++i) {
      const auto [a, b] = refinement->parents[i];
      const Index p = point_of_added[i];
      world.col(p) = 0.5 * (world.col(point_of(a)) + world.col(point_of(b)));
    }
  }
  for (const Limb& limb : limbs) limb.show(morph, world);
}

Status SketchModel::find_joints() {
  for (Limb& limb : limbs) {
    if (Status status = limb.find_joints(); !status.ok()) return status;
  }
  return {};
}

// -- Posing.

Status Sketch::bend(const Stroke& target, bool unfinished) {
  if (Status status = check_stroke(target, "target"); !status.ok()) return status;
  const PlaneCurve& reference = impl_->curve();
  const Stroke whole = unfinished ? continued(target, impl_->reference_pixels) : target;
  const Polyline pixels = from_held_end(filtered(whole, reference.size()), impl_->held_at_end);
  Polyline nodes = without_start(pixels, impl_->start);
  for (auto node : nodes.colwise()) {
    node = impl_->limbs.front().camera().at_depth(node, impl_->limbs.front().depth());
  }
  const PlaneCurve curve(std::move(nodes));
  SketchPose& pose = impl_->base;
  pose.heading = angle_between(curve.heading(), reference.heading());
  pose.length = curve.step() / reference.step();
  for (std::size_t i = 0; i < pose.turns.size(); ++i) {
    pose.turns[i] = curve.turns()[i] - reference.turns()[i];
  }
  impl_->pose_changed(unfinished);
  return {};
}

void Sketch::unbend() {
  SketchPose& pose = impl_->base;
  pose.heading = 0.0;
  pose.length = 1.0;
  std::fill(pose.turns.begin(), pose.turns.end(), 0.0);
  impl_->pose_changed();
}

Status Sketch::twist(double radians) {
  if (!std::isfinite(radians)) return invalid("twist is not finite; expected an angle");
  if (radians != 0.0) {
    if (Status status = impl_->find_joints(); !status.ok()) return status;
  }
  impl_->twist_angle = radians;
  impl_->base.twist = radians == 0.0 ? Profile::constant(0.0) : impl_->twist_speed.times(radians);
  impl_->pose_changed();
  return {};
}

namespace {

Status check_scale(const Profile& factor) {
  for (const auto& [s, f] : factor.points()) {
    if (f > 0.0) continue;
    return invalid(message({"scale is ", f, " at s = ", s, "; expected factors above 0"}));
  }
  return {};
}

}  // namespace

Status Sketch::set_scale(const Profile& factor) {
  if (Status status = check_scale(factor); !status.ok()) return status;
  if (Status status = impl_->find_joints(); !status.ok()) return status;
  impl_->base.scale = factor;
  impl_->pose_changed();
  return {};
}

void Sketch::set_turning(const Profile& offset) {
  impl_->turning = offset;
  impl_->pose_changed();
}

void Sketch::set_twist_speed(const Profile& speed) {
  impl_->twist_speed = speed;
  if (impl_->twist_angle == 0.0) return;
  impl_->base.twist = speed.times(impl_->twist_angle);
  impl_->pose_changed();
}

bool Sketch::smooth() const { return impl_->smooth; }

void Sketch::set_smooth(bool smooth) {
  impl_->smooth = smooth;
  for (Limb& limb : impl_->limbs) limb.set_smooth(smooth);
  impl_->pose_changed();
}

Status Sketch::set_morph(double t) {
  if (!(t >= 0.0 && t <= 1.0)) {
    return invalid(message({"morph is ", t, "; expected a number from 0 to 1"}));
  }
  impl_->morph = t;
  impl_->show();
  return {};
}

void Sketch::reset() {
  impl_->base = SketchPose::rest(impl_->curve());
  impl_->turning = impl_->twist_speed = Profile::identity();
  impl_->twist_angle = 0.0;
  impl_->morph = 1.0;
  impl_->pose_changed();
}

SketchPose Sketch::pose() const { return impl_->whole_pose(); }

Status Sketch::set_pose(const SketchPose& pose) {
  if (pose.turns.size() != impl_->base.turns.size()) {
    return invalid(message({"pose.turns has length ", pose.turns.size(), "; expected ", impl_->base.turns.size(),
                            ", those of this reference"}));
  }
  const bool finite =
      std::isfinite(pose.heading) && std::isfinite(pose.length) &&
      std::all_of(pose.turns.begin(), pose.turns.end(), [](double turn) { return std::isfinite(turn); });
  if (!finite || !(pose.length > 0.0)) {
    return invalid("pose has a number that is not finite or no length; expected those of pose()");
  }
  if (Status status = check_scale(pose.scale); !status.ok()) return status;
  if (pose.twists() || pose.scales()) {
    if (Status status = impl_->find_joints(); !status.ok()) return status;
  }
  impl_->base = pose;
  impl_->turning = impl_->twist_speed = Profile::identity();
  impl_->twist_angle = 0.0;
  impl_->pose_changed();
  return {};
}

}  // namespace pliant
