#include "pliant/sketch/tether.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "pliant/geometry/edge_distance.h"

namespace pliant {
namespace {

using Neighbour = std::pair<Index, double>;  // and the distance to it

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
    const auto for_each_neighbour = [&](Index i, const auto& visit) {
      for (const auto& [j, distance] : neighbours[i]) visit(j, rate * distance);
    };
    spread_distances(for_each_neighbour, unbounded, bounds);
    for (Index i = 0; i < free; ++i) values[i] = sign * std::min(sign * values[i], bounds[i]);
  }
}

}  // namespace pliant
