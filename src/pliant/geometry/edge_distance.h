// Shortest paths along edges.
#pragma once

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "pliant/core/types.h"
#include "pliant/geometry/adjacency.h"

namespace pliant {

/// Lowers every value to the least of (another point's value + length of the shortest path to it),
/// as far as that is at most `reach` (Dijkstra). Infinite values are no sources.
/// for_each_neighbour(i, visit) calls visit(j, length of the edge, at least 0).
template <class Neighbours>
void spread_distances(const Neighbours& for_each_neighbour, double reach, std::vector<double>& values) {
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (Index i = 0; i < static_cast<Index>(values.size()); ++i) {
    if (values[i] < std::numeric_limits<double>::infinity()) queue.push({values[i], i});
  }
  while (!queue.empty()) {
    const Entry nearest = queue.top();
    const Index i = nearest.second;
    queue.pop();
    if (nearest.first > values[i]) continue;
    for_each_neighbour(i, [&](Index j, double length) {
      const double next = nearest.first + length;
      if (next > reach || next >= values[j]) return;
      values[j] = next;
      queue.push({next, j});
    });
  }
}

/// The same along the edges of triangles; around: their `triangles_of_points`.
void spread_distances(const Points& points, const Triangles& triangles, const Incidence& around, double reach,
                      std::vector<double>& values);

}  // namespace pliant
