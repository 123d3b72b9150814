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

/// An edge of a triangle; equal edges stand together when sorted.
struct Side {
  Index low, high, triangle, opposite;
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sorted_sides(const Triangles& triangles, std::span<const Index> chosen) {
  std::vector<Side> sides;
  sides.reserve(3 * chosen.size());
  for (const Index t : chosen) {
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangles(c, t), triangles((c + 1) % 3, t));
      sides.push_back({low, high, t, triangles((c + 2) % 3, t)});
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
    : points_(points), triangles_(triangles), part_(part), distance_(distance) {
  find_loops();
}

bool PlaneCut::crossed(Index t) const {
  const int ahead = (distance_[triangles_(0, t)] >= 0.0) + (distance_[triangles_(1, t)] >= 0.0) +
                    (distance_[triangles_(2, t)] >= 0.0);
  return ahead != 0 && ahead != 3;
}

void PlaneCut::find_pieces() {
  DisjointSets pieces(static_cast<Index>(points_.cols()));
  for (const Index t : part_) {
    const Index a = triangles_(0, t), b = triangles_(1, t), c = triangles_(2, t);
    const bool at_a = distance_[a] >= 0.0, at_b = distance_[b] >= 0.0, at_c = distance_[c] >= 0.0;
    if (at_a == at_b) pieces.join(a, b);
    if (at_a == at_c) pieces.join(a, c);
    if (at_a != at_b && at_b == at_c) pieces.join(b, c);
  }
  piece_ = pieces.roots();
}

Index PlaneCut::piece_of(const CutLoop& loop, bool ahead) const {
  for (const Index corner : triangles_.col(loop.triangles.front())) {
    if ((distance_[corner] >= 0.0) == ahead) return piece_[corner];
  }
  return -1;
}

void PlaneCut::find_loops() {
  std::vector<Index> across;
  for (const Index t : part_) {
    if (crossed(t)) across.push_back(t);
  }
  DisjointSets sets(static_cast<Index>(across.size()));
  const auto place = [&](Index t) {
    return static_cast<Index>(std::lower_bound(across.begin(), across.end(), t) - across.begin());
  };
  const std::vector<Side> sides = sorted_sides(triangles_, across);
  const auto is_crossed = [&](const Side& side) {
    return (distance_[side.low] >= 0.0) != (distance_[side.high] >= 0.0);
  };
  for_each_run(sides, [&](auto first, auto last) {
    for (auto next = first + 1; is_crossed(*first) && next != last; ++next) {
      sets.join(place(first->triangle), place(next->triangle));
    }
  });

  const DisjointSets::Numbered loop = sets.numbered();
  loops_.resize(loop.count);
  for (std::size_t i = 0; i < across.size(); ++i) loops_[loop.of[i]].triangles.push_back(across[i]);
  std::vector<std::vector<Eigen::Vector3d>> crossings(loop.count);
  const auto crossing = [&](Index a, Index b) -> Eigen::Vector3d {
    const double share = distance_[a] / (distance_[a] - distance_[b]);
    return (1.0 - share) * points_.col(a) + share * points_.col(b);
  };
  for_each_run(sides, [&](auto first, auto) {
    if (!is_crossed(*first)) return;
    crossings[loop.of[place(first->triangle)]].push_back(crossing(first->low, first->high));
  });
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    loops_[l].crossings.resize(3, static_cast<Index>(crossings[l].size()));
    for (std::size_t i = 0; i < crossings[l].size(); ++i) {
      loops_[l].crossings.col(static_cast<Index>(i)) = crossings[l][i];
    }
    for (const Index t : loops_[l].triangles) {
      // The corner alone on its side.
      int c = 0;
      const auto is_ahead = [&](int k) { return distance_[triangles_(k % 3, t)] >= 0.0; };
      while (is_ahead(c) == is_ahead(c + 1) || is_ahead(c) == is_ahead(c + 2)) ++c;
      const Index tip = triangles_(c, t);
      loops_[l].length +=
          (crossing(tip, triangles_((c + 1) % 3, t)) - crossing(tip, triangles_((c + 2) % 3, t))).norm();
    }
  }
}

const std::vector<Index>& PlaneCut::separate(Index first) {
  find_pieces();
  DisjointSets groups(static_cast<Index>(piece_.size()));
  const Index source = behind(loops_[first]), sink = ahead(loops_[first]);
  for (const CutLoop& loop : loops_) {
    const Index a = groups.find(behind(loop)), b = groups.find(ahead(loop));
    const Index s = groups.find(source), t = groups.find(sink);
    const bool merges = (a == s && b == t) || (a == t && b == s);
    if (!merges) groups.join(a, b);
  }
  group_ = groups.roots();
  behind_ = group_[source];
  ahead_ = group_[sink];
  kept_.clear();
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    if (group_[behind(loops_[l])] != group_[ahead(loops_[l])]) {
      kept_.push_back(static_cast<Index>(l));
    }
  }
  return kept_;
}

CutSide PlaneCut::side_of(Index point) const {
  const Index group = group_[piece_[point]];
  return group == behind_ ? CutSide::behind : (group == ahead_ ? CutSide::ahead : CutSide::outside);
}

std::vector<CutSide> PlaneCut::sides(double band) const {
  assert(behind_ >= 0);
  // By the plane first: a crossed triangle goes with two of its corners.
  std::vector<CutSide> result;
  result.reserve(part_.size());
  std::vector<Index> near, place_in_part;
  for (const Index t : part_) {
    const CutSide a = side_of(triangles_(0, t)), b = side_of(triangles_(1, t)), c = side_of(triangles_(2, t));
    result.push_back(a == b || a == c ? a : b);
    double low = distance_[triangles_(0, t)], high = low;
    for (const Index corner : triangles_.col(t)) {
      low = std::min(low, distance_[corner]);
      high = std::max(high, distance_[corner]);
    }
    if (result.back() != CutSide::outside && low <= band && high >= -band) {
      near.push_back(t);
      place_in_part.push_back(static_cast<Index>(result.size()) - 1);
    }
  }

  // Those that hang together with a loop that is cut.
  const auto place = [&](Index t) {
    return static_cast<Index>(std::lower_bound(near.begin(), near.end(), t) - near.begin());
  };
  const std::vector<Side> edges = sorted_sides(triangles_, near);
  DisjointSets sets(static_cast<Index>(near.size()));
  for_each_run(edges, [&](auto first, auto last) {
    for (auto next = first + 1; next != last; ++next) {
      sets.join(place(first->triangle), place(next->triangle));
    }
  });
  std::vector<bool> is_fuzzy(near.size(), false);
  for (const Index l : kept_) is_fuzzy[sets.find(place(loops_[l].triangles.front()))] = true;
  const auto fuzzy = [&](Index t) { return is_fuzzy[sets.find(place(t))]; };

  std::vector<Terminal> nodes(near.size(), Terminal::none);
  std::vector<CutEdge> graph;
  bool has_source = false, has_sink = false;
  for_each_run(edges, [&](auto first, auto last) {
    if (!fuzzy(first->triangle)) return;
    const Index a = first->low, b = first->high;
    if (last - first == 1) {
      // Beyond the band the surface goes on; within it, or across the plane, it ends.
      if (std::min(std::abs(distance_[a]), std::abs(distance_[b])) <= band) return;
      if ((distance_[a] >= 0.0) != (distance_[b] >= 0.0)) return;
      const bool is_source = side_of(a) == CutSide::behind;
      nodes[place(first->triangle)] = is_source ? Terminal::source : Terminal::sink;
      (is_source ? has_source : has_sink) = true;
      return;
    }
    const auto& corners = triangles_.col(first->triangle);
    const int at = corner_across(triangles_, first->triangle, a, b);
    for (auto next = first + 1; next != last; ++next) {
      const double cost = cut_cost(points_.col(corners[(at + 1) % 3]), points_.col(corners[(at + 2) % 3]),
                                   points_.col(corners[at]), points_.col(next->opposite));
      graph.push_back({place(first->triangle), place(next->triangle), cost});
    }
  });
  if (!has_source || !has_sink) return result;
  const std::vector<bool> beyond = min_cut(nodes, graph);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (fuzzy(near[i])) result[place_in_part[i]] = beyond[i] ? CutSide::ahead : CutSide::behind;
  }
  return result;
}

}  // namespace pliant
