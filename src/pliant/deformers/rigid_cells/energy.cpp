#include "pliant/deformers/rigid_cells/energy.h"

#include <cmath>

#include <Eigen/Geometry>

namespace pliant::cells {

Glue::Glue(const Eigen::Vector3d& center_i, const Eigen::Vector3d& center_j, double side_i, double side_j,
           double weight, int dimension)
    : apart(center_i - center_j) {
  const double ratio = side_j / side_i;
  const double volume_ratio = dimension == 2 ? ratio * ratio : ratio * ratio * ratio;
  weight_i = weight / (1.0 + volume_ratio);
  weight_j = weight - weight_i;
  turn = (weight_i * side_i * side_i + weight_j * side_j * side_j) / 12.0;
}

Glue::Residuals Glue::residuals(const CellMotion& i, const CellMotion& j) const {
  // At rest both differences are the same sums: exactly zero.
  const Eigen::Vector3d between = i.center - j.center;
  return {between - j.rotation * apart, between - i.rotation * apart};
}

double Glue::energy(const CellMotion& i, const CellMotion& j) const {
  const Residuals r = residuals(i, j);
  return weight_i * r.at_i.squaredNorm() + weight_j * r.at_j.squaredNorm() +
         turn * (i.rotation - j.rotation).squaredNorm();
}

double Glue::linearize(const CellMotion& i, const CellMotion& j, Inertia& stiffness, double* wrench_i,
                       double* wrench_j) const {
  // The difference T_i - T_j at a place x changes by (a - b) at the middle between T_i x and T_j x,
  // and by (a + b) / 2 turning the difference itself: that part is left out, since it changes no
  // length.
  const Residuals r = residuals(i, j);
  const Eigen::Vector3d middle_i = i.center - 0.5 * r.at_i, middle_j = j.center + 0.5 * r.at_j;
  stiffness = Inertia();
  stiffness.add_point(weight_i, middle_i);
  stiffness.add_point(weight_j, middle_j);
  const Eigen::Matrix3d mean = 0.5 * (i.rotation + j.rotation), difference = i.rotation - j.rotation;
  const Eigen::Matrix3d spread = turn * mean * mean.transpose();
  const double trace = spread.trace();
  for (int k = 0; k < 3; ++k) stiffness.second[k] += trace - spread(k, k);
  stiffness.second[3] -= spread(0, 1);
  stiffness.second[4] -= spread(0, 2);
  stiffness.second[5] -= spread(1, 2);

  const Eigen::Vector3d force_i = weight_i * r.at_i, force_j = weight_j * r.at_j;
  const Eigen::Vector3d force = force_i + force_j;
  Eigen::Vector3d torque = middle_i.cross(force_i) + middle_j.cross(force_j);
  for (int k = 0; k < 3; ++k) torque += turn * mean.col(k).cross(difference.col(k));
  for (int k = 0; k < 3; ++k) {
    wrench_i[k] += force[k];
    wrench_j[k] -= force[k];
    wrench_i[3 + k] += torque[k];
    wrench_j[3 + k] -= torque[k];
  }
  return weight_i * r.at_i.squaredNorm() + weight_j * r.at_j.squaredNorm() + turn * difference.squaredNorm();
}

CellMotion moved(const CellMotion& motion, const double* twist, double share) {
  const Eigen::Vector3d v = share * Eigen::Vector3d(twist[0], twist[1], twist[2]);
  const Eigen::Vector3d w = share * Eigen::Vector3d(twist[3], twist[4], twist[5]);
  CellMotion result;
  result.center = motion.center + v + w.cross(motion.center);
  const double length = w.norm();
  if (length == 0.0) {
    result.rotation = motion.rotation;
  } else {
    result.rotation = Eigen::AngleAxisd(std::atan(length), w / length).toRotationMatrix() * motion.rotation;
  }
  return result;
}

}  // namespace pliant::cells
