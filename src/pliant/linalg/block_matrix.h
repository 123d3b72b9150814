// A symmetric matrix of dense blocks over a graph: one diagonal block a node, one block an edge.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "pliant/core/sort.h"
#include "pliant/core/types.h"

namespace pliant {

/// An undirected edge (j, k) with j < k.
using Edge = std::array<Index, 2>;

/// B x B blocks, column-major. `off_diagonal` holds the block in rows of edge[1], columns of
/// edge[0] (the lower triangle); only the lower triangle of a diagonal block is read.
struct BlockMatrix {
  int block = 1;  ///< B
  Index nodes = 0;
  std::vector<Edge> edges;           ///< sorted, without duplicates
  std::vector<double> diagonal;      ///< nodes x B x B
  std::vector<double> off_diagonal;  ///< edges x B x B

  void set_zero(int block_size, Index node_count, std::vector<Edge> sorted_edges) {
    block = block_size;
    nodes = node_count;
    edges = std::move(sorted_edges);
    diagonal.assign(static_cast<std::size_t>(nodes) * block * block, 0.0);
    off_diagonal.assign(edges.size() * block * block, 0.0);
  }
  /// Whether it is laid out so; only then do numbers of edges and nodes mean the same to both.
  bool has_pattern(int block_size, Index node_count, const std::vector<Edge>& sorted_edges) const {
    return block == block_size && nodes == node_count && edges == sorted_edges;
  }
  /// Sets the edges and their scalars (B is 1) from entries in any order; those of one edge are
  /// summed in the order given.
  void sum_off_diagonal(const std::vector<std::pair<Edge, double>>& entries) {
    edges.clear();
    off_diagonal.clear();
    const auto key = [&](Index i) { return key_of(entries[i].first[0], entries[i].first[1]); };
    for (const Index i : order_by(static_cast<Index>(entries.size()), key)) {
      const auto& [edge, value] = entries[i];
      if (edges.empty() || edges.back() != edge) {
        edges.push_back(edge);
        off_diagonal.push_back(0.0);
      }
      off_diagonal.back() += value;
    }
  }
  double* diagonal_block(Index j) { return diagonal.data() + static_cast<std::size_t>(j) * block * block; }
  double* edge_block(std::size_t e) { return off_diagonal.data() + e * block * block; }
  const double* diagonal_block(Index j) const { return diagonal.data() + static_cast<std::size_t>(j) * block * block; }
  const double* edge_block(std::size_t e) const { return off_diagonal.data() + e * block * block; }
};

}  // namespace pliant
