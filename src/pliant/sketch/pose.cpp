#include "pliant/sketch/pose.h"

#include <algorithm>
#include <cassert>

namespace pliant {

SketchPose SketchPose::blend(const SketchPose& a, const SketchPose& b, double t) {
  assert(a.turns.size() == b.turns.size());
  SketchPose pose;
  pose.heading = (1.0 - t) * a.heading + t * b.heading;
  pose.length = (1.0 - t) * a.length + t * b.length;
  for (std::size_t i = 0; i < a.turns.size(); ++i) {
    pose.turns.push_back((1.0 - t) * a.turns[i] + t * b.turns[i]);
  }
  pose.twist = Profile::blend(a.twist, b.twist, t);
  pose.scale = Profile::blend(a.scale, b.scale, t);
  return pose;
}

SketchPose SketchPose::rest(const PlaneCurve& reference) {
  SketchPose pose;
  pose.turns.assign(reference.turns().size(), 0.0);
  return pose;
}

bool SketchPose::bends() const {
  return heading != 0.0 || length != 1.0 ||
         std::any_of(turns.begin(), turns.end(), [](double turn) { return turn != 0.0; });
}

PlaneCurve bent(const PlaneCurve& reference, const SketchPose& pose, double t) {
  std::vector<double> turns = reference.turns();
  assert(turns.size() == pose.turns.size());
  for (std::size_t i = 0; i < turns.size(); ++i) turns[i] += t * pose.turns[i];
  return PlaneCurve(reference.nodes().col(0), reference.heading() + t * pose.heading, std::move(turns),
                    reference.step() * (1.0 + t * (pose.length - 1.0)));
}

}  // namespace pliant
