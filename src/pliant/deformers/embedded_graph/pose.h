// The transformations of the nodes, as displacements from rest in the solver's frame.
#pragma once

#include <Eigen/Geometry>

#include "pliant/core/types.h"

namespace pliant::embedded {

/// 12 x m: column j holds the rows (U_j | t_j) of node j, U_j = R_j - I, one after the other.
using Pose = Eigen::Matrix<double, 12, Eigen::Dynamic>;

inline Eigen::Matrix3d gradient_of(const Pose& pose, Index j) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(pose.col(j).data()).leftCols<3>();
}

inline Eigen::Vector3d translation_of(const Pose& pose, Index j) { return {pose(3, j), pose(7, j), pose(11, j)}; }

/// Derivative of the determinant, d det(R) = <cofactors, dR>, and det(R) times the inverse
/// transpose.
inline Eigen::Matrix3d cofactors(const Eigen::Matrix3d& r) {
  Eigen::Matrix3d c;
  c << r.col(1).cross(r.col(2)), r.col(2).cross(r.col(0)), r.col(0).cross(r.col(1));
  return c;
}

/// The three vectors of unknowns of GraphEnergy, where no node is frozen.
inline Eigen::VectorXd unknowns_of(const Pose& pose) {
  Eigen::VectorXd x(pose.size());
  const Eigen::Index rows = 4 * pose.cols();
  for (Eigen::Index j = 0; j < pose.cols(); ++j) {
    for (int a = 0; a < 3; ++a) x.segment<4>(a * rows + 4 * j) = pose.col(j).segment<4>(4 * a);
  }
  return x;
}

}  // namespace pliant::embedded
