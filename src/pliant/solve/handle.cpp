#include "pliant/solve/handle.h"

namespace pliant {

Eigen::Affine3d Motion::map() const {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (angle != 0.0) turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  Eigen::Affine3d map;
  map.linear() = scale * turn;
  const Eigen::Vector3d fixed = (1.0 - scale) * center;  // where scaling takes the origin
  map.translation() = translation + turn * (fixed - about) + about;
  return map;
}

Eigen::Vector3d turn_between(const std::optional<Motion>& before, const Motion& after) {
  const Eigen::Vector3d axis = after.axis.normalized();
  if (!before) return Eigen::Vector3d::Zero();
  if (before->angle == 0.0) return after.angle * axis;
  const double along = before->axis.normalized().dot(axis);
  if (std::abs(along) < 1.0 - 1e-9) return Eigen::Vector3d::Zero();
  return (after.angle - std::copysign(before->angle, along * before->angle)) * axis;
}

void exchange(NamedFields& fields, Motion& motion) {
  fields("scale", motion.scale);
  fields("center", motion.center);
  fields("axis", motion.axis);
  fields("angle", motion.angle);
  fields("about", motion.about);
  fields("translation", motion.translation);
}

}  // namespace pliant
