// Quadratic forms of twists that look like the inertia of rigid bodies: all that solving needs.
//
// A twist (v, w), six numbers, is the velocity field x -> v + w x x; a wrench (f, t) what works on it.
// The linearised energy of a pair of cells is a form K of the difference of their twists, and K has
// the shape of a rigid body's inertia: mass, first moment, second moment about the origin. Sums of
// such forms are such forms again; so are the diagonal blocks of the system and all that a coarser
// level of a multigrid method has. Ten numbers in the place of 36, and their inverse is as small.
#pragma once

#include <Eigen/Core>

namespace pliant::cells {

/// (v, w) -> (m v + w x s, s x v + J w).
struct Inertia {
  double mass = 0.0;
  double first[3] = {};   ///< s, the sum of mass times place
  double second[6] = {};  ///< J about the origin: xx, yy, zz, xy, xz, yz

  Inertia& operator+=(const Inertia& other) {
    mass += other.mass;
    for (int k = 0; k < 3; ++k) first[k] += other.first[k];
    for (int k = 0; k < 6; ++k) second[k] += other.second[k];
    return *this;
  }
  Inertia scaled(double factor) const {
    Inertia result = *this;
    result.mass *= factor;
    for (double& s : result.first) s *= factor;
    for (double& j : result.second) j *= factor;
    return result;
  }
  /// Of a point mass at a place.
  void add_point(double m, const Eigen::Vector3d& at) {
    mass += m;
    for (int k = 0; k < 3; ++k) first[k] += m * at[k];
    const double xx = m * at.x() * at.x(), yy = m * at.y() * at.y(), zz = m * at.z() * at.z();
    second[0] += yy + zz;
    second[1] += xx + zz;
    second[2] += xx + yy;
    second[3] -= m * at.x() * at.y();
    second[4] -= m * at.x() * at.z();
    second[5] -= m * at.y() * at.z();
  }
  /// wrench += K twist.
  void apply(const double* twist, double* wrench) const {
    const double *v = twist, *w = twist + 3, *s = first, *j = second;
    wrench[0] += mass * v[0] + w[1] * s[2] - w[2] * s[1];
    wrench[1] += mass * v[1] + w[2] * s[0] - w[0] * s[2];
    wrench[2] += mass * v[2] + w[0] * s[1] - w[1] * s[0];
    wrench[3] += s[1] * v[2] - s[2] * v[1] + j[0] * w[0] + j[3] * w[1] + j[4] * w[2];
    wrench[4] += s[2] * v[0] - s[0] * v[2] + j[3] * w[0] + j[1] * w[1] + j[5] * w[2];
    wrench[5] += s[0] * v[1] - s[1] * v[0] + j[4] * w[0] + j[5] * w[1] + j[2] * w[2];
  }
  Eigen::Matrix<double, 6, 6> dense() const;
};

/// The twist a wrench leads to: the inverse of an inertia; that of a body which can only turn about a
/// point; or nothing, of one that is held.
struct Compliance {
  double inverse_mass = 0.0;
  double center[3] = {};
  double inverse_second[6] = {};  ///< about the centre

  static Compliance of_free(const Inertia& inertia);
  static Compliance about(const Inertia& inertia, const Eigen::Vector3d& point);
  /// twist = C wrench.
  void apply(const double* wrench, double* twist) const {
    const double *f = wrench, *c = center, *j = inverse_second;
    const double t[3] = {wrench[3] - (c[1] * f[2] - c[2] * f[1]), wrench[4] - (c[2] * f[0] - c[0] * f[2]),
                         wrench[5] - (c[0] * f[1] - c[1] * f[0])};
    const double w[3] = {j[0] * t[0] + j[3] * t[1] + j[4] * t[2], j[3] * t[0] + j[1] * t[1] + j[5] * t[2],
                         j[4] * t[0] + j[5] * t[1] + j[2] * t[2]};
    twist[0] = inverse_mass * f[0] - (w[1] * c[2] - w[2] * c[1]);
    twist[1] = inverse_mass * f[1] - (w[2] * c[0] - w[0] * c[2]);
    twist[2] = inverse_mass * f[2] - (w[0] * c[1] - w[1] * c[0]);
    twist[3] = w[0];
    twist[4] = w[1];
    twist[5] = w[2];
  }
};

}  // namespace pliant::cells
