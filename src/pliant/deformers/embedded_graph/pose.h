// The transformations of the nodes, as displacements from rest in the solver's frame.
#pragma once

#include "pliant/core/types.h"

namespace pliant::embedded {

/// 12 x m: column j holds the rows (U_j | t_j) of node j, U_j = R_j - I, one after the other.
using Pose = Eigen::Matrix<double, 12, Eigen::Dynamic>;

inline Eigen::Matrix3d gradient_of(const Pose& pose, Index j) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(pose.col(j).data())
      .leftCols<3>();
}

inline Eigen::Vector3d translation_of(const Pose& pose, Index j) {
  return {pose(3, j), pose(7, j), pose(11, j)};
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
