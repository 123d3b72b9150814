// Linear systems over cells: conjugate gradients with a multigrid cycle over the octree.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "pliant/core/types.h"
#include "pliant/deformers/rigid_cells/inertia.h"

namespace pliant::cells {

/// How free a cell is.
enum class Freedom : unsigned char { free, turns, held };

/// The form: sum over pairs of (x_i - x_j) . K_ij (x_i - x_j), x_i the twist of cell i. Cells that are
/// held have none; those that turn about a point have (-w x point, w).
///
/// A coarser level takes the cells of one cube of twice the width that hang together as one body: its
/// system is then of the same kind, with the sums of the K between bodies. A W-cycle of one symmetric
/// Gauss-Seidel sweep a level, the coarsest solved exactly; coarse corrections are stretched, since
/// bodies of rigid cells are too stiff.
class Multigrid {
 public:
  /// The pattern. corners: of the cells, in units of the smallest; pairs (i, j), i < j, sorted.
  void set_up(std::vector<Eigen::Vector3i> corners, const std::vector<Freedom>& freedom,
              const std::vector<std::array<Index, 2>>& pairs);
  /// K of each pair, to be filled before `prepare`.
  std::vector<Inertia>& stiffness() { return levels_.front().stiffness; }
  /// The places that cells turn about; others are not read. Takes the values of `stiffness`.
  void prepare(const Points& pivots);
  /// Solves in place, 6 numbers a cell, until the residual is below a part `tolerance` of what it was
  /// (in the norm of the cycle) or after `most` iterations. Entries of held cells become zero.
  /// Returns the iterations.
  int solve(Eigen::VectorXd& x, double tolerance, int most);

  bool is_held(Index node) const { return levels_.front().freedom[node] == Freedom::held; }
  Index levels() const { return static_cast<Index>(levels_.size()); }

 private:
  struct Neighbour {
    Index node, pair;
  };
  struct Level {
    Index size = 0;
    std::vector<std::array<Index, 2>> pairs;
    std::vector<Inertia> stiffness;     ///< of the pairs
    std::vector<Inertia> ground;        ///< to what is held, of each node
    std::vector<Compliance> inverse;    ///< of the diagonal
    std::vector<Index> offsets, later;  ///< of each node in neighbours; the first that comes after it
    std::vector<Neighbour> neighbours;  ///< ascending
    std::vector<Freedom> freedom;
    std::vector<Index> parent;       ///< body of the next level, -1: none
    std::vector<Index> pair_parent;  ///< pair of the next level, or kInside, or kGround - body
    std::vector<double> b, x;
    std::vector<double> first, product;  ///< of the first of two cycles
  };
  static constexpr Index kInside = -1, kGround = -2;

  void link(Level& level);
  bool coarsen(const Level& fine, std::vector<Eigen::Vector3i>& at, int width, Level& coarse,
               std::vector<Index>& parent, std::vector<Index>& pair_parent) const;
  void invert_diagonal(Level& level, const Points* pivots);
  void factorize_coarsest();
  void solve_coarsest(Level& level);
  static void sweep_forwards(Level& level);
  static void sweep_backwards(Level& level);
  static void restrict_residual(const Level& fine, Level& coarse);
  static void prolong(const Level& coarse, Level& fine);
  void cycle(std::size_t l);
  void cycle_twice(std::size_t l);
  static void multiply(const Level& level, const double* x, double* y);

  std::vector<Level> levels_;
  std::vector<double> dense_, dense_packed_;
  Eigen::VectorXd residual_, direction_, product_;
};

}  // namespace pliant::cells
