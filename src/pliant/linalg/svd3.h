// The singular value decomposition of 3 x 3 matrices, compiled once: inlined Eigen decompositions
// are the heaviest code in the WASM module.
#pragma once

#include <Eigen/Core>

namespace pliant {

/// matrix = u * diag(values) * v', values descending, u and v orthogonal (of either handedness). Of
/// a symmetric positive semi-definite matrix u holds eigenvectors and values the eigenvalues.
struct Svd3 {
  Eigen::Matrix3d u, v;
  Eigen::Vector3d values;
};
Svd3 svd3(const Eigen::Matrix3d& matrix);

}  // namespace pliant
