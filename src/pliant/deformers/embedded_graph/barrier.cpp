#include "pliant/deformers/embedded_graph/barrier.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace pliant::embedded::barrier {

double value(double determinant) {
  const double s = determinant / kSafeDeterminant;
  if (s >= 1.0) return 0.0;
  if (!(s > 0.0)) return std::numeric_limits<double>::infinity();
  return -(1.0 - s) * (1.0 - s) * std::log(s);
}

double slope(double determinant) {
  const double s = determinant / kSafeDeterminant;
  if (s >= 1.0) return 0.0;
  return (2.0 * (1.0 - s) * std::log(s) - (1.0 - s) * (1.0 - s) / s) / kSafeDeterminant;
}

double curvature(double determinant) {
  const double s = determinant / kSafeDeterminant;
  if (s >= 1.0) return 0.0;
  const double q = (1.0 - s) / s;
  return (-2.0 * std::log(s) + 4.0 * q + q * q) / (kSafeDeterminant * kSafeDeterminant);
}

DeterminantAlong::DeterminantAlong(const Eigen::Matrix3d& r, const Eigen::Matrix3d& d) {
  auto mixed = [](const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return a.col(0).dot(b.col(1).cross(b.col(2))) + b.col(0).dot(a.col(1).cross(b.col(2))) +
           b.col(0).dot(b.col(1).cross(a.col(2)));
  };
  c_ = {r.determinant(), mixed(d, r), mixed(r, d), d.determinant()};
}

}  // namespace pliant::embedded::barrier
