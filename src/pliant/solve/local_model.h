// Energies that are quadratic once their local quantities (rotations, directions) are known:
//   E(x) = sum_k w_k |L_k x - z_k(x)|^2
// with constant w_k and L_k. The matrix sum_k w_k L_k' L_k never changes; what the local quantities
// do to the minimum passes through the gradient only.
#pragma once

#include <vector>

#include "pliant/core/types.h"
#include "pliant/linalg/block_matrix.h"

namespace pliant {

/// One 3 x 3 matrix a point, column-major: 9 x p.
using Rotations = Eigen::Matrix<double, 9, Eigen::Dynamic>;

class LocalModel {
 public:
  virtual ~LocalModel() = default;

  /// The constant matrix over all points, blocks of 1; it need not be definite where parts float.
  virtual BlockMatrix matrix() const = 0;
  /// E at x (3 x p), with local quantities fitted to x; half_gradient: 3 x p, half of dE/dx.
  virtual double evaluate(const Points& x, Points& half_gradient) = 0;
  /// The deformation stands at x, where `evaluate` was called last.
  virtual void accept() {}
  /// Half the gradient at x of sum_k w_k |L_k x - Q_k L_k from|^2: minimising it over x moves
  /// `from` by the turns Q (one a point) as well as the constraints allow.
  virtual void turned_gradient(const Points& from, const Rotations& turns, const Points& x,
                               Points& half_gradient) const = 0;
  /// Which points belong to parts that something holds; before the first evaluation, and again when
  /// constraints change.
  virtual void set_anchored(const std::vector<bool>& anchored) { (void)anchored; }
  /// By how much the matrix exceeds the curvature of E in the directions that take longest: what
  /// local quantities that follow take out of it. Steps beyond the first are this much longer.
  virtual double slack() const { return 1.0; }
  /// A stiffness of the size of the energy's second derivatives: 1 for weights without a unit.
  virtual double stiffness() const = 0;
};

}  // namespace pliant
