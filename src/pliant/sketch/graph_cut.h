// The cheapest cut through a graph between two sets of nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// An undirected edge that costs `capacity` >= 0 to cut.
struct CutEdge {
  Index a, b;
  double capacity;
};

/// What a node is tied to.
enum class Terminal : std::uint8_t { none, source, sink };

/// Boykov and Kolmogorov's max-flow (Boost.Graph). Returns for every node whether it lies on the
/// sink's side of a cut of least capacity; of several such cuts, the one nearest to the source.
/// Capacities count to 1e-9 of the largest.
std::vector<bool> min_cut(std::span<const Terminal> nodes, std::span<const CutEdge> edges);

}  // namespace pliant
