// What eliminating the nodes of a sparse symmetric matrix one after the other does to its pattern.
#pragma once

#include <vector>

#include "pliant/linalg/block_matrix.h"

namespace pliant::elimination {

/// Of each place in elimination order: other places.
using Adjacency = std::vector<std::vector<Index>>;

/// Neighbours in the graph of the matrix. position: node -> place.
Adjacency adjacency_in_order(const BlockMatrix& matrix, const std::vector<Index>& position);

/// Elimination tree (Liu 1990): parent of each column, -1 at a root.
std::vector<Index> elimination_tree(const Adjacency& adjacency);

/// Children before parents, each subtree contiguous: order[place] = column.
std::vector<Index> postorder(const std::vector<Index>& parent);

/// Row structure of every column of L below its diagonal, ascending.
Adjacency column_structure(const Adjacency& adjacency, const std::vector<Index>& parent);

}  // namespace pliant::elimination
