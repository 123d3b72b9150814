// Orders of elimination that keep the factor of a sparse matrix small.
#pragma once

#include <vector>

#include "pliant/linalg/block_matrix.h"

namespace pliant {

/// Approximate minimum degree over a graph: order[place] = node. The order of a graph is a good
/// order of its subgraphs, too.
std::vector<Index> fill_reducing_order(Index nodes, const std::vector<Edge>& edges);

}  // namespace pliant
