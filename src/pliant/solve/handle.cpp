#include "pliant/solve/handle.h"

#include <Eigen/Geometry>

namespace pliant {

Eigen::Vector3d Motion::apply(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d scaled = center + scale * (p - center);
  if (angle == 0.0) return scaled + translation;
  return about + Eigen::AngleAxisd(angle, axis.normalized()) * (scaled - about) + translation;
}

}  // namespace pliant
