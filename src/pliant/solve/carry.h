// Carries points along with what moves them: nodes of a graph, cells.
#pragma once

#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// The k things that move each point, and by how much: row i of `indices` and `weights` is point i.
struct Influences {
  int k = 0;
  std::vector<Index> indices;   ///< p x k, nearest first
  std::vector<double> weights;  ///< p x k, each row sums to one

  Index size() const { return k == 0 ? 0 : static_cast<Index>(indices.size()) / k; }
};

/// Affine maps of what moves points, twelve doubles each, in the order the carrying loop wants them:
/// (A00 A10)(A01 A11)(A02 A12)(b0 b1)(A20 A21)(A22 b2) for p -> A p + b.
using PackedMaps = Eigen::Matrix<double, 12, Eigen::Dynamic>;

Eigen::Matrix<double, 12, 1> pack_map(const Eigen::Matrix3d& a, const Eigen::Vector3d& b);

/// out_i = p_i + sum over the influences of w (A (p_i - origin) + b), for 3 x n points: maps are in
/// displacements, so that points at rest come out bit for bit.
void carry(const PackedMaps& maps, const Influences& influences, const Points& points, const Eigen::Vector3d& origin,
           Points& out);

}  // namespace pliant
