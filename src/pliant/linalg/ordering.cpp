#include "pliant/linalg/ordering.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace pliant {

std::vector<Index> fill_reducing_order(Index nodes, const std::vector<Edge>& edges) {
  // Eigen reads the pattern of a symmetric matrix with both triangles.
  using Pattern = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(2 * edges.size() + nodes);
  for (Index j = 0; j < nodes; ++j) entries.emplace_back(j, j, 1.0);
  for (const auto& [j, k] : edges) {
    entries.emplace_back(j, k, 1.0);
    entries.emplace_back(k, j, 1.0);
  }
  Pattern pattern(nodes, nodes);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  const auto& indices = permutation.indices();
  return std::vector<Index>(indices.data(), indices.data() + indices.size());
}

}  // namespace pliant
