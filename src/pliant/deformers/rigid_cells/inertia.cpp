#include "pliant/deformers/rigid_cells/inertia.h"

#include <algorithm>

namespace pliant::cells {
namespace {

/// A second moment's eigenvalues count as at least this part of its trace.
constexpr double kLeastShare = 1e-12;

/// The inverse of a symmetric positive semi-definite 3 x 3 matrix (xx, yy, zz, xy, xz, yz), by
/// cofactors.
void invert(const double* a, double* inverse) {
  const double more = kLeastShare * (a[0] + a[1] + a[2]);
  const double xx = a[0] + more, yy = a[1] + more, zz = a[2] + more, xy = a[3], xz = a[4], yz = a[5];
  const double c0 = yy * zz - yz * yz, c3 = xz * yz - xy * zz, c4 = xy * yz - xz * yy;
  const double determinant = xx * c0 + xy * c3 + xz * c4;
  const double scale = determinant > 0.0 ? 1.0 / determinant : 0.0;
  inverse[0] = scale * c0;
  inverse[1] = scale * (xx * zz - xz * xz);
  inverse[2] = scale * (xx * yy - xy * xy);
  inverse[3] = scale * c3;
  inverse[4] = scale * c4;
  inverse[5] = scale * (xy * xz - xx * yz);
}

}  // namespace

Eigen::Matrix<double, 6, 6> Inertia::dense() const {
  Eigen::Matrix<double, 6, 6> matrix;
  for (int k = 0; k < 6; ++k) {
    Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
    const Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Unit(k);
    apply(twist.data(), wrench.data());
    matrix.col(k) = wrench;
  }
  return matrix;
}

Compliance Compliance::of_free(const Inertia& inertia) {
  Compliance result;
  if (!(inertia.mass > 0.0)) return result;
  Inertia centered = inertia;
  result.inverse_mass = 1.0 / inertia.mass;
  Eigen::Vector3d center;
  for (int k = 0; k < 3; ++k) center[k] = result.center[k] = inertia.first[k] / inertia.mass;
  centered.add_point(-inertia.mass, center);
  invert(centered.second, result.inverse_second);
  return result;
}

Compliance Compliance::about(const Inertia& inertia, const Eigen::Vector3d& point) {
  // J about p is J about the origin - m about p/.. : |x - p|^2 I - (x - p)(x - p)' summed.
  Compliance result;
  const Eigen::Vector3d s(inertia.first);
  const double trace = inertia.mass * point.squaredNorm() - 2.0 * s.dot(point);
  Eigen::Matrix3d shift = trace * Eigen::Matrix3d::Identity() - inertia.mass * point * point.transpose() +
                          s * point.transpose() + point * s.transpose();
  double second[6] = {inertia.second[0] + shift(0, 0), inertia.second[1] + shift(1, 1),
                      inertia.second[2] + shift(2, 2), inertia.second[3] + shift(0, 1),
                      inertia.second[4] + shift(0, 2), inertia.second[5] + shift(1, 2)};
  for (int k = 0; k < 3; ++k) result.center[k] = point[k];
  invert(second, result.inverse_second);
  return result;
}

}  // namespace pliant::cells
