// The step kernel of energies with a constant matrix (local_model.h): the points that are held
// leave the system, the rest is factorised once and serves as the metric of a quasi-Newton method
// on the energy with its local quantities eliminated. With an empty memory a full step is the
// classic local-global step; the memory learns what the constant matrix does not know, and the
// minimum stays the same.
#pragma once

#include <utility>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/linalg/sparse_cholesky.h"
#include "pliant/solve/approach.h"
#include "pliant/solve/lbfgs.h"
#include "pliant/solve/local_model.h"

namespace pliant {

/// The part of each point, 0 .. : connected through entries of the matrix.
std::vector<Index> parts_of(const BlockMatrix& matrix);
/// Holds the first point of every part that has no held one, so that the rest of the matrix is
/// definite. Returns which points belong to parts that were held before.
std::vector<bool> hold_one_a_part(const std::vector<Index>& parts, std::vector<bool>& held);

class LocalGlobal {
 public:
  /// Takes the points that are not held as unknowns, analyses and factorises.
  /// Errors: too_large, not_solvable.
  Status set_up(const BlockMatrix& matrix, std::vector<bool> held);
  /// Other values in the same pattern. Errors: not_solvable.
  Status refactorize(const BlockMatrix& matrix);

  struct Outcome {
    bool accepted = false;
    bool converged = false;
  };
  /// One accepted step from x (3 x p), which it moves, or the finding that none lowers the energy.
  /// Converged: the relative change of the energy (energies below `noise` count as 0) is at most `tolerance`, and so
  /// are the largest move and what is left of the way (approach.h), over `diagonal`; or nothing but rounding is left
  /// of the gradient. Held points stay where they are, and so do parts whose gradient is rounding.
  Outcome step(LocalModel& model, Points& x, double tolerance, double diagonal, double noise);

  /// The energy at x is not the one of the last step any more (other targets, other weights).
  void restart();
  /// Past steps say nothing about the ones to come.
  void forget() { memory_.clear(); }

  /// Sets the free columns of `values` (3 x p) to what the matrix makes of the held ones: its
  /// harmonic extension.
  void extend(Points& values);
  /// x -= matrix^-1 half_gradient on the free points: the minimum of a quadratic with this matrix.
  void relax(const Points& half_gradient, Points& x);

  double energy() const { return energy_; }
  Index unknowns() const { return 3 * free_count(); }
  int factorizations() const { return factorizations_; }
  int analyses() const { return analyses_; }

 private:
  using Vector = Eigen::VectorXd;

  Index free_count() const { return static_cast<Index>(point_of_free_.size()); }
  BlockMatrix reduced(const BlockMatrix& matrix);
  Status factorize(const BlockMatrix& system);
  void gather(const Points& values, Vector& unknowns) const;
  void move(const Points& from, double alpha, const Vector& direction, Points& to) const;
  /// Takes over half the gradient at x, but for parts where it is rounding.
  void take_gradient(const Points& half_gradient, const Points& x);
  /// Of parts without a gradient: what a step does to others is none of their business.
  void clear_still(Vector& v) const;
  /// Where to go from the gradient that stands; the slope of the energy along it.
  double find_direction(double slack);
  /// Moves to `trial_`, `alpha` along the direction.
  void accept(LocalModel& model, Points& x, double alpha, double energy);
  /// The longest move of a point by the last step.
  double longest_move() const;

  std::vector<Index> free_of_point_;  ///< -1: held
  std::vector<Index> point_of_free_;
  std::vector<std::pair<Edge, double>> coupling_;  ///< (free, held point) and the matrix entry
  SparseCholesky factor_;
  std::vector<double> diagonal_;     ///< of the matrix, a free point
  std::vector<Index> part_of_free_;  ///< connected through entries between free points
  std::vector<bool> still_;          ///< parts without a gradient
  Approach approach_;
  Lbfgs memory_{6};         ///< more pairs cost more than they save
  bool evaluated_ = false;  ///< energy_ and gradient_ belong to the present x
  double energy_ = 0.0;
  Vector gradient_, direction_, previous_, step_;
  Points trial_, half_gradient_;
  int factorizations_ = 0;
  int analyses_ = 0;
};

}  // namespace pliant
