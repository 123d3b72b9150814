// Interpolation by triharmonic radial basis functions.
#pragma once

#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// The interpolant sum of w_k |x - c_k|^3 + a linear polynomial through values at centres c_k: in space
/// the smoothest there is (triharmonic, C^2); in the plane as smooth, and as well posed with a linear
/// polynomial, which r^4 log r is not (Wendland: Scattered Data Approximation, 8.3). Values of a
/// linear function are reproduced. Where the centres lie in a plane, on a line or in a point, the
/// polynomial does not change across it.
///
/// Only places matter to the factorisation, not values: interpolation is a weighted sum of them.
class RadialBasis {
 public:
  /// centers: 3 x n, distinct, n >= 1. Memory: n^2 numbers.
  explicit RadialBasis(Points centers);

  /// Weights of the values at the centres that make up `factor` times the interpolant at a place,
  /// summed over several places: n numbers.
  Eigen::VectorXd weights(const Points& places, const Eigen::VectorXd& factors);

  Index size() const { return static_cast<Index>(centers_.cols()); }

 private:
  void choose_base();
  Eigen::VectorXd base_polynomials(const Eigen::Vector3d& place) const;

  Points centers_;
  std::vector<Index> base_;                               ///< up to four centres that fix a linear polynomial
  std::vector<Index> rest_;                               ///< the others
  Eigen::Matrix3d directions_ = Eigen::Matrix3d::Zero();  ///< of the base, orthonormal columns
  Eigen::Matrix3d edges_ = Eigen::Matrix3d::Identity();   ///< base - first, along them: upper triangle
  Eigen::MatrixXd at_base_;                               ///< |c - b|^3, n x base
  Eigen::MatrixXd polynomials_;                           ///< of the base at the other centres
  std::vector<double> factor_, packed_;
};

}  // namespace pliant
