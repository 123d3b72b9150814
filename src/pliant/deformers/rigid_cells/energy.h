// The elastic glue between rigid cells (Botsch 2007, eq. 1 and 2), in closed form for cubes and, in
// the plane, squares.
#pragma once

#include <vector>

#include "pliant/deformers/rigid_cells/inertia.h"
#include "pliant/linalg/block_matrix.h"

namespace pliant::cells {

/// x -> rotation (x - rest centre) + center.
struct CellMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

/// One pair {i, j}. With T(x) = R x + t, V the volumes and s the sides of the cells,
///   w_ij E_ij = w_ij / (V_i + V_j) sum over c in {i, j} of
///               V_c ( |(T_i - T_j)(rest centre of c)|^2 + s_c^2 / 12 |R_i - R_j|_F^2 ).
struct Glue {
  Eigen::Vector3d apart;                  ///< rest centre of i - that of j
  double weight_i = 0.0, weight_j = 0.0;  ///< w_ij V / (V_i + V_j)
  double turn = 0.0;                      ///< weight of |R_i - R_j|_F^2

  /// weight: w_ij with stiffness. dimension: 2 or 3.
  Glue(const Eigen::Vector3d& center_i, const Eigen::Vector3d& center_j, double side_i, double side_j, double weight,
       int dimension);

  double energy(const CellMotion& i, const CellMotion& j) const;

  /// Moves the cells by small twists a and b: the energy becomes energy + 2 wrench . (a - b) +
  /// (a - b) . stiffness (a - b). Exact in first order; in second order up to a part that vanishes
  /// with the residual and with it makes the form positive. Adds `wrench` (6) to one list and takes
  /// it from another.
  double linearize(const CellMotion& i, const CellMotion& j, Inertia& stiffness, double* wrench_i,
                   double* wrench_j) const;

 private:
  struct Residuals {
    Eigen::Vector3d at_i, at_j;  ///< (T_i - T_j) of the two centres
  };
  Residuals residuals(const CellMotion& i, const CellMotion& j) const;
};

/// A cell moved by a twist and taken to the closest rigid motion: for a cube it turns by atan |w|
/// about w, in the place of an eigen-analysis of its corners.
CellMotion moved(const CellMotion& motion, const double* twist, double share);

}  // namespace pliant::cells
