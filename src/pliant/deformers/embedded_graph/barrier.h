// Keeps det R > 0 at every node. E_rot (eq. 5) admits reflections, and under strong local turns the
// exact minimum of eq. 9 has them: shapes turned inside out. The solver minimises eq. 9 subject to
// det R > 0 by a barrier that is zero, with its first two derivatives, above kSafeDeterminant, so
// that wherever no node is about to collapse the paper's energy is all there is.
#pragma once

#include <array>

#include <Eigen/Core>

namespace pliant::embedded::barrier {

inline constexpr double kSafeDeterminant = 0.1;

/// b(s) = -(1 - s)^2 ln s for s = determinant / kSafeDeterminant < 1; infinite at 0 and below.
/// (The form is that of the contact barrier of Li et al. 2020, Incremental Potential Contact.)
double value(double determinant);
/// Derivative by the determinant.
double slope(double determinant);
/// Second derivative; never negative.
double curvature(double determinant);

/// det(R + alpha D), a cubic in alpha.
class DeterminantAlong {
 public:
  DeterminantAlong(const Eigen::Matrix3d& r, const Eigen::Matrix3d& d);
  double at_start() const { return c_[0]; }
  double at(double alpha) const { return c_[0] + alpha * (c_[1] + alpha * (c_[2] + alpha * c_[3])); }

 private:
  std::array<double, 4> c_;
};

}  // namespace pliant::embedded::barrier
