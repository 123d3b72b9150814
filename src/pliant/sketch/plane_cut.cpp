#include "pliant/sketch/plane_cut.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "pliant/core/disjoint_sets.h"
#include "pliant/core/sort.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/sketch/graph_cut.h"

namespace pliant {
namespace {

constexpr double kConcave = 1.0, kConvex = 0.2;  // eta
constexpr double kLeastCost = 0.01;              // of the length

/// An edge of a triangle, which is given by its place among those chosen; equal edges stand together when sorted.
struct Side {
  Index low, high, triangle, opposite;
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sorted_sides(const Triangles& triangles, std::span<const Index> chosen) {
  std::vector<Side> sides;
  sides.reserve(3 * chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Index t = chosen[i];
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangles(c, t), triangles((c + 1) % 3, t));
      sides.push_back({low, high, static_cast<Index>(i), triangles((c + 2) % 3, t)});
    }
  }
  return sorted_by(sides, [](const Side& side) { return key_of(side.low, side.high); });
}

/// Calls visit(first, last) for the sides of every edge.
template <class Visit>
void for_each_run(const std::vector<Side>& sides, Visit&& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first + 1;
    while (last != sides.end() && last->same_edge(*first)) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace

double cut_cost(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d) {
  const double length = (b - a).norm();
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const Eigen::Vector3d m = (a - b).cross(d - b);
  const double bend = std::atan2(n.cross(m).norm(), n.dot(m));
  const double eta = n.dot(d - a) > 0.0 ? kConcave : kConvex;
  return length * std::max(kLeastCost, 1.0 - eta * bend / std::numbers::pi);
}

std::vector<Index> connected_points(const Triangles& triangles, Index points) {
  DisjointSets sets(points);
  for (Index t = 0; t < triangles.cols(); ++t) {
    sets.join(triangles(0, t), triangles(1, t));
    sets.join(triangles(0, t), triangles(2, t));
  }
  return sets.roots();
}

PlaneCut::PlaneCut(const Points& points, const Triangles& triangles, std::span<const Index> part,
                   std::span<const double> distance)
    : points_(points), triangles_(triangles), part_(part), distance_(distance), ahead_(distance.size()) {
  for (std::size_t p = 0; p < distance.size(); ++p) ahead_[p] = distance[p] >= 0.0;
  find_loops();
}

bool PlaneCut::is_crossed(Index t) const {
  const auto first = ahead_[triangles_(0, t)];
  return first != ahead_[triangles_(1, t)] || first != ahead_[triangles_(2, t)];
}

void PlaneCut::find_pieces() {
  DisjointSets pieces(static_cast<Index>(points_.cols()));
  for (const Index t : part_) {
    const Index a = triangles_(0, t), b = triangles_(1, t), c = triangles_(2, t);
    const auto at_a = ahead_[a], at_b = ahead_[b], at_c = ahead_[c];
    if (at_a == at_b) pieces.join(a, b);
    if (at_a == at_c) pieces.join(a, c);
    if (at_a != at_b && at_b == at_c) pieces.join(b, c);
  }
  piece_ = pieces.roots();
}

Index PlaneCut::piece_of(const CutLoop& loop, bool ahead) const {
  const auto& corners = triangles_.col(loop.triangles.front());
  int c = 0;  // a crossed triangle has corners on both sides
  while (is_ahead(corners[c]) != ahead) ++c;
  return piece_[corners[c]];
}

void PlaneCut::find_loops() {
  std::vector<Index> across;
  for (const Index t : part_) {
    if (is_crossed(t)) across.push_back(t);
  }
  DisjointSets sets(static_cast<Index>(across.size()));
  const std::vector<Side> sides = sorted_sides(triangles_, across);
  const auto crosses = [&](const Side& side) { return ahead_[side.low] != ahead_[side.high]; };
  for_each_run(sides, [&](auto first, auto last) {
    for (auto next = first + 1; crosses(*first) && next != last; ++next) {
      sets.join(first->triangle, next->triangle);
    }
  });

  const DisjointSets::Numbered loop = sets.numbered();
  loops_.resize(loop.count);
  for (std::size_t i = 0; i < across.size(); ++i) loops_[loop.of[i]].triangles.push_back(across[i]);
  std::vector<std::vector<Eigen::Vector3d>> crossings(loop.count);
  const auto crossing = [&](Index a, Index b) -> Eigen::Vector3d {
    const double t = distance_[a] / (distance_[a] - distance_[b]);
    return (1.0 - t) * points_.col(a) + t * points_.col(b);
  };
  for_each_run(sides, [&](auto first, auto) {
    if (!crosses(*first)) return;
    crossings[loop.of[first->triangle]].push_back(crossing(first->low, first->high));
  });
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    loops_[l].crossings.resize(3, static_cast<Index>(crossings[l].size()));
    for (std::size_t i = 0; i < crossings[l].size(); ++i) {
      loops_[l].crossings.col(static_cast<Index>(i)) = crossings[l][i];
    }
    for (const Index t : loops_[l].triangles) {
      // The corner alone on its side.
      int c = 0;
      const auto ahead = [&](int k) { return ahead_[triangles_(k % 3, t)]; };
      while (ahead(c) == ahead(c + 1) || ahead(c) == ahead(c + 2)) ++c;
      const Index tip = triangles_(c, t);
      loops_[l].length +=
          (crossing(tip, triangles_((c + 1) % 3, t)) - crossing(tip, triangles_((c + 2) % 3, t))).norm();
    }
  }
}

const std::vector<Index>& PlaneCut::separate(Index first, bool connected) {
  const auto points = static_cast<Index>(points_.cols());
  side_.resize(points);
  if (connected && loops_.size() == 1) {
    for (Index p = 0; p < points; ++p) side_[p] = is_ahead(p) ? CutSide::ahead : CutSide::behind;
    return kept_ = {first};
  }
  find_pieces();
  DisjointSets groups(points);
  const Index source = behind(loops_[first]), sink = ahead(loops_[first]);
  for (const CutLoop& loop : loops_) {
    const Index a = groups.find(behind(loop)), b = groups.find(ahead(loop));
    const Index s = groups.find(source), t = groups.find(sink);
    const bool merges = (a == s && b == t) || (a == t && b == s);
    if (!merges) groups.join(a, b);
  }
  const std::vector<Index> group = groups.roots();
  kept_.clear();
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    if (group[behind(loops_[l])] != group[ahead(loops_[l])]) kept_.push_back(static_cast<Index>(l));
  }
  for (Index p = 0; p < points; ++p) {
    const Index own = group[piece_[p]];
    side_[p] = own == group[source] ? CutSide::behind : (own == group[sink] ? CutSide::ahead : CutSide::outside);
  }
  return kept_;
}

std::vector<CutSide> PlaneCut::sides_of_plane() const {
  assert(!side_.empty());
  std::vector<CutSide> sides(part_.size());
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const auto& corners = triangles_.col(part_[i]);
    const CutSide a = side_[corners[0]], b = side_[corners[1]], c = side_[corners[2]];
    sides[i] = a == b || a == c ? a : b;
  }
  return sides;
}

std::vector<CutSide> PlaneCut::sides(double band) const {
  std::vector<CutSide> result = sides_of_plane();
  std::vector<Index> near, place_in_part;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const auto& corners = triangles_.col(part_[i]);
    const double a = distance_[corners[0]], b = distance_[corners[1]], c = distance_[corners[2]];
    const bool beside = std::min(a, std::min(b, c)) > band || std::max(a, std::max(b, c)) < -band;
    if (beside || result[i] == CutSide::outside) continue;
    near.push_back(part_[i]);
    place_in_part.push_back(static_cast<Index>(i));
  }

  // Those that hang together with a loop that is cut.
  const std::vector<Side> edges = sorted_sides(triangles_, near);
  DisjointSets sets(static_cast<Index>(near.size()));
  for_each_run(edges, [&](auto first, auto last) {
    for (auto next = first + 1; next != last; ++next) sets.join(first->triangle, next->triangle);
  });
  const std::vector<Index> set = sets.roots();
  std::vector<bool> is_fuzzy(near.size(), false);
  for (const Index l : kept_) {
    const auto place = std::lower_bound(near.begin(), near.end(), loops_[l].triangles.front());
    is_fuzzy[set[place - near.begin()]] = true;
  }
  const auto fuzzy = [&](std::size_t i) { return is_fuzzy[set[i]]; };

  std::vector<Terminal> nodes(near.size(), Terminal::none);
  std::vector<CutEdge> graph;
  bool has_source = false, has_sink = false;
  for_each_run(edges, [&](auto first, auto last) {
    if (!fuzzy(first->triangle)) return;
    const Index a = first->low, b = first->high;
    if (last - first == 1) {
      // Beyond the band the surface goes on; within it, or across the plane, it ends.
      if (std::min(std::abs(distance_[a]), std::abs(distance_[b])) <= band) return;
      if (is_ahead(a) != is_ahead(b)) return;
      const bool is_source = side_[a] == CutSide::behind;
      nodes[first->triangle] = is_source ? Terminal::source : Terminal::sink;
      (is_source ? has_source : has_sink) = true;
      return;
    }
    const auto& corners = triangles_.col(near[first->triangle]);
    const int at = corner_across(triangles_, near[first->triangle], a, b);
    for (auto next = first + 1; next != last; ++next) {
      const double cost = cut_cost(points_.col(corners[(at + 1) % 3]), points_.col(corners[(at + 2) % 3]),
                                   points_.col(corners[at]), points_.col(next->opposite));
      graph.push_back({first->triangle, next->triangle, cost});
    }
  });
  if (!has_source || !has_sink) return result;
  const std::vector<bool> beyond = min_cut(nodes, graph);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (fuzzy(i)) result[place_in_part[i]] = beyond[i] ? CutSide::ahead : CutSide::behind;
  }
  return result;
}

}  // namespace pliant
