#include "pliant/deformers/embedded_graph/graph.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "pliant/geometry/nearest_points.h"
#include "pliant/geometry/sampling.h"
#include "pliant/geometry/simplify.h"
#include "pliant/linalg/ordering.h"

namespace pliant {
namespace {

constexpr int kDefaultNeighbours = 4;
/// Weights below this are rounding of a zero; as zeros they make no edge.
constexpr double kNoInfluence = 1e-12;

/// The nodes nearest to a point, nearest first, with their squared distances.
struct Nearest {
  std::vector<Index> nodes;
  std::vector<double> squared;

  /// Drops the nodes across each cut: those on the other side than the point, or, for a point on
  /// neither side, than the first node that is on one.
  void respect(const std::vector<CutSides>& node_sides, std::span<const unsigned char> point_sides) {
    for (std::size_t c = 0; c < node_sides.size(); ++c) {
      unsigned char side = point_sides[c];
      std::size_t kept = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const unsigned char other = node_sides[c][nodes[i]];
        if (side == 0) side = other;
        if (other != 0 && other != side) continue;
        nodes[kept] = nodes[i];
        squared[kept++] = squared[i];
      }
      nodes.resize(kept);
      squared.resize(kept);
    }
  }
};

/// Eq. 4 for one point: weights of its first k nodes, normalised. d_max is the distance to node
/// k + 1; where there is none, twice that to node k. Equal weights where all distances are equal.
void write_weights(const Nearest& nearest, int k, Index* indices, double* weights) {
  const std::size_t found = nearest.nodes.size();
  const int used = std::min<int>(k, static_cast<int>(found));
  const double d_max =
      found > static_cast<std::size_t>(k) ? std::sqrt(nearest.squared[k]) : 2.0 * std::sqrt(nearest.squared[used - 1]);
  double sum = 0.0;
  for (int s = 0; s < used; ++s) {
    const double closeness = d_max > 0.0 ? 1.0 - std::sqrt(nearest.squared[s]) / d_max : 0.0;
    indices[s] = nearest.nodes[s];
    weights[s] = closeness * closeness < kNoInfluence ? 0.0 : closeness * closeness;
    sum += weights[s];
  }
  for (int s = 0; s < used; ++s) weights[s] = sum > 0.0 ? weights[s] / sum : 1.0 / used;
  // Fewer than k nodes on this side of a cut: repeat the nearest without weight.
  for (int s = used; s < k; ++s) {
    indices[s] = nearest.nodes[0];
    weights[s] = 0.0;
  }
}

/// point_sides: one list a cut over the points.
Influences influences_of(const Points& nodes, const std::vector<CutSides>& node_sides, int k, const Points& points,
                         const std::vector<CutSides>& point_sides) {
  const NearestPoints tree(nodes);
  const std::size_t all = static_cast<std::size_t>(nodes.cols());
  const std::size_t wanted = std::min<std::size_t>(k + 1, all);
  Influences result;
  result.k = k;
  result.indices.resize(static_cast<std::size_t>(points.cols()) * k);
  result.weights.resize(result.indices.size());
  Nearest nearest;
  std::vector<unsigned char> sides(point_sides.size());
  for (Index i = 0; i < points.cols(); ++i) {
    for (std::size_t c = 0; c < sides.size(); ++c) sides[c] = point_sides[c][i];
    // Across a cut nodes drop out: ask for more until enough are left.
    for (std::size_t count = wanted;; count = std::min(all, 4 * count)) {
      tree.find(points.col(i), static_cast<Index>(count), nearest.nodes, nearest.squared);
      nearest.respect(node_sides, sides);
      if (nearest.nodes.size() >= wanted || count == all) break;
    }
    const std::size_t row = static_cast<std::size_t>(i) * k;
    write_weights(nearest, k, result.indices.data() + row, result.weights.data() + row);
  }
  return result;
}

std::vector<Edge> edges_of(const Influences& influences, Index nodes) {
  std::vector<std::vector<Index>> above(nodes);  // neighbours with a higher id
  const int k = influences.k;
  for (Index i = 0; i < influences.size(); ++i) {
    const Index* node = influences.indices.data() + static_cast<std::size_t>(i) * k;
    const double* weight = influences.weights.data() + static_cast<std::size_t>(i) * k;
    for (int a = 0; a < k; ++a) {
      for (int b = a + 1; b < k; ++b) {
        if (weight[a] == 0.0 || weight[b] == 0.0 || node[a] == node[b]) continue;
        auto& list = above[std::min(node[a], node[b])];
        const Index other = std::max(node[a], node[b]);
        if (std::find(list.begin(), list.end(), other) == list.end()) list.push_back(other);
      }
    }
  }
  std::vector<Edge> edges;
  for (Index j = 0; j < nodes; ++j) {
    std::sort(above[j].begin(), above[j].end());
    for (Index other : above[j]) edges.push_back({j, other});
  }
  return edges;
}

double mean_edge_length(const Points& nodes, const std::vector<Edge>& edges, double fallback) {
  double sum = 0.0;
  for (const auto& [j, k] : edges) sum += (nodes.col(j) - nodes.col(k)).norm();
  if (sum > 0.0) return sum / static_cast<double>(edges.size());
  return fallback > 0.0 ? fallback : 1.0;
}

CutSides point_sides_of(const Shape& shape, const Cut& cut) {
  CutSides sides(shape.points().cols(), 0);
  for (Index vertex : cut.a) sides[shape.point_of_vertex()[vertex]] = 1;
  for (Index vertex : cut.b) sides[shape.point_of_vertex()[vertex]] = 2;
  return sides;
}

/// A node or foreign point belongs to the side of the point of the shape nearest to it.
std::vector<CutSides> sides_by_nearest(const Shape& shape, const std::vector<CutSides>& point_sides,
                                       const Points& queries) {
  std::vector<CutSides> result(point_sides.size(), CutSides(queries.cols(), 0));
  if (point_sides.empty()) return result;
  const NearestPoints tree(shape.points());
  Nearest nearest;
  for (Index j = 0; j < queries.cols(); ++j) {
    tree.find(queries.col(j), 1, nearest.nodes, nearest.squared);
    for (std::size_t c = 0; c < result.size(); ++c) result[c][j] = point_sides[c][nearest.nodes[0]];
  }
  return result;
}

}  // namespace

Result<Points> place_nodes(const Shape& shape, const EmbeddedGraphOptions& options) {
  const Index count =
      options.node_count > 0 ? options.node_count : std::min<Index>(250, static_cast<Index>(shape.points().cols()));
  switch (options.sampling) {
    case NodeSampling::nodes:
      return options.nodes;
    case NodeSampling::surface:
      return sample_surface(shape, count, options.seed);
    case NodeSampling::simplify: {
      auto survivors = simplify(shape, {.target_points = count});
      if (!survivors.ok()) return survivors.status();
      return Points(shape.points()(Eigen::all, *survivors));
    }
  }
  return options.nodes;
}

DeformationGraph build_graph(const Shape& shape, Points nodes, const EmbeddedGraphOptions& options) {
  DeformationGraph graph;
  graph.nodes = std::move(nodes);
  const int k = options.neighbours > 0 ? options.neighbours : std::min<int>(kDefaultNeighbours, graph.size());
  for (const Cut& cut : options.cuts) graph.point_sides.push_back(point_sides_of(shape, cut));
  graph.node_sides = sides_by_nearest(shape, graph.point_sides, graph.nodes);
  graph.influences = influences_of(graph.nodes, graph.node_sides, k, shape.points(), graph.point_sides);
  graph.edges = edges_of(graph.influences, graph.size());
  graph.elimination_order = fill_reducing_order(graph.size(), graph.edges);
  graph.length_unit = mean_edge_length(graph.nodes, graph.edges, shape.diagonal());
  graph.origin = 0.5 * (shape.points().rowwise().minCoeff() + shape.points().rowwise().maxCoeff());
  return graph;
}

Influences compute_influences(const Shape& shape, const DeformationGraph& graph, const Points& points) {
  return influences_of(graph.nodes, graph.node_sides, graph.influences.k, points,
                       sides_by_nearest(shape, graph.point_sides, points));
}

}  // namespace pliant
