#include "pliant/sketch/tether.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace pliant {
namespace {

using Neighbour = std::pair<Index, double>;  // and the distance to it

/// start + rate times the distance along edges, the least over the points with a finite start
/// (Dijkstra).
void spread_bounds(const std::vector<std::vector<Neighbour>>& neighbours, double rate, std::vector<double>& bounds) {
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (Index i = 0; i < static_cast<Index>(bounds.size()); ++i) {
    if (bounds[i] < std::numeric_limits<double>::infinity()) queue.push({bounds[i], i});
  }
  while (!queue.empty()) {
    const auto [bound, i] = queue.top();
    queue.pop();
    if (bound > bounds[i]) continue;
    for (const auto& [j, distance] : neighbours[i]) {
      const double next = bound + rate * distance;
      if (next < bounds[j]) {
        bounds[j] = next;
        queue.push({next, j});
      }
    }
  }
}

}  // namespace

void tether(const Points& points, std::span<const Index> point_of_local, std::span<const std::array<Index, 2>> edges,
            std::span<const double> pinned, double slack, double rate, std::span<double> values) {
  const auto free = static_cast<Index>(values.size());
  const auto length = [&](Index a, Index b) {
    return (points.col(point_of_local[a]) - points.col(point_of_local[b])).norm();
  };
  const bool holds = std::all_of(edges.begin(), edges.end(), [&](const std::array<Index, 2>& edge) {
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    return low >= free || high < free ||
           std::abs(values[low] - pinned[high - free]) <= slack + rate * length(low, high);
  });
  if (holds) return;

  std::vector<std::vector<Neighbour>> neighbours(point_of_local.size());
  for (const auto& [a, b] : edges) {
    const double distance = length(a, b);
    neighbours[a].emplace_back(b, distance);
    neighbours[b].emplace_back(a, distance);
  }
  const double unbounded = std::numeric_limits<double>::infinity();
  // The lower bound is the upper one of the negated values.
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> bounds(point_of_local.size(), unbounded);
    for (std::size_t k = 0; k < pinned.size(); ++k) bounds[free + k] = sign * pinned[k] + slack;
    spread_bounds(neighbours, rate, bounds);
    for (Index i = 0; i < free; ++i) values[i] = sign * std::min(sign * values[i], bounds[i]);
  }
}

}  // namespace pliant
