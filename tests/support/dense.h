// Sparse matrices as dense ones, for oracles.
#pragma once

#include <Eigen/Core>

#include "pliant/linalg/block_matrix.h"

namespace pliant::test {

inline Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  const int b = matrix.block;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.nodes * b, matrix.nodes * b);
  for (Index j = 0; j < matrix.nodes; ++j) {
    const Eigen::Map<const Eigen::MatrixXd> block(matrix.diagonal_block(j), b, b);
    result.block(j * b, j * b, b, b) = block.selfadjointView<Eigen::Lower>();
  }
  for (std::size_t e = 0; e < matrix.edges.size(); ++e) {
    const auto [j, k] = matrix.edges[e];
    const Eigen::Map<const Eigen::MatrixXd> block(matrix.edge_block(e), b, b);
    result.block(k * b, j * b, b, b) = block;
    result.block(j * b, k * b, b, b) = block.transpose();
  }
  return result;
}

}  // namespace pliant::test
