// Smoothing of the deformation's parameters over the region. Kho and Garland, section 5.4.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Minimises eq. 9 over the free points of a region, pinned ones given:
///   sum_i sum_j w_ij (u_i - u_j)^2 + w_c (u_i - raw_i)^2,  w_ij = 1 / |v_i - v_j|,
///   sum_j w_ij = 10 w_c.
/// Its matrix has a condition of 41 at most, whatever the mesh: conjugate gradients with an
/// incomplete factor, computed once, need a dozen passes over the edges where the fill of a
/// complete factor would cost more than it saves.
class ParameterSmoother {
 public:
  ParameterSmoother() = default;
  /// points: 3 x p; edges between local ids, each once: below free.size() free, else pinned;
  /// point_of_local: free points, then pinned ones.
  ParameterSmoother(const Points& points, std::span<const Index> point_of_local, Index free,
                    std::span<const std::array<Index, 2>> edges);

  /// raw: of the free points; pinned: of the pinned ones; u: of the free ones, a guess on the way
  /// in. Root mean square error about `tolerance` of the largest value. Returns the passes it took.
  int solve(std::span<const double> raw, std::span<const double> pinned, std::span<double> u, double tolerance = 1e-8);

  Index size() const { return static_cast<Index>(diagonal_.size()); }

 private:
  void factorize();
  void residual(std::span<const double> raw, std::span<const double> pinned, std::span<const double> u);
  void forward(double* v) const;
  void backward(double* v) const;

  struct Link {
    Index free, pinned;
    double weight;
  };
  std::vector<Index> offsets_;  ///< rows of the strictly lower triangle
  std::vector<Index> columns_;
  std::vector<double> weights_;  ///< w_ij
  std::vector<double> lower_;    ///< of the factor I + L, scaled to a unit diagonal
  std::vector<Link> links_;
  std::vector<double> fidelity_;  ///< w_c / 2
  std::vector<double> diagonal_;  ///< of the matrix, eq. 9 halved twice
  std::vector<double> scale_;     ///< 1 / sqrt of the incomplete factor's diagonal
  std::vector<double> rest_;      ///< scaled diagonal minus 2
  std::vector<double> r_, z_, p_, t_, q_;
  double mass_ = 0.0;  ///< sum of the factor's diagonal
};

}  // namespace pliant
