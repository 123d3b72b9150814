// Keeps det R > 0 at every node. E_rot (eq. 5) admits reflections, and under strong local turns the
// exact minimum of eq. 9 has them: shapes turned inside out. The solver minimises eq. 9 plus a
// barrier w_rot sum b(det R_j) that is zero, with its first two derivatives, above kSafeDeterminant,
// so that wherever no node is about to collapse the paper's energy is all there is.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "pliant/deformers/embedded_graph/energy.h"

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
  double slope_at(double alpha) const { return c_[1] + alpha * (2.0 * c_[2] + alpha * 3.0 * c_[3]); }

 private:
  std::array<double, 4> c_;
};

// Over all free nodes, at unknowns x of the energy.

/// Sum of b; infinite where a node is reflected.
double sum(const GraphEnergy& energy, const Vector& x);
/// Adds half the gradient of w_rot sum b.
void add_half_gradient(const GraphEnergy& energy, const Vector& x, Vector& gradient);
/// Adds the part of half its Hessian that is definite, to a matrix of 12 x 12 blocks.
void add_half_curvature(const GraphEnergy& energy, const Vector& x, BlockMatrix& matrix);

/// The line search: how far F + w_rot sum b falls from x along d, and the sum there.
struct Fall {
  double alpha = 0.0;  ///< 0: nowhere
  double barrier = 0.0;
};
/// course: of F along d. slope: of both at x, below 0. `along` is memory.
Fall first_minimum(const GraphEnergy& energy, const Quartic& course, double slope, const Vector& x, const Vector& d,
                   std::vector<DeterminantAlong>& along);

}  // namespace pliant::embedded::barrier
