#include "pliant/sketch/graph_cut.h"

#include <vector>

#include <doctest/doctest.h>

#include "pliant/geometry/adjacency.h"
#include "pliant/sketch/plane_cut.h"
#include "support/random.h"
#include "support/shapes.h"

namespace pliant {
namespace {

double cost(const std::vector<bool>& beyond, const std::vector<CutEdge>& edges) {
  double sum = 0.0;
  for (const CutEdge& edge : edges) {
    if (beyond[edge.a] != beyond[edge.b]) sum += edge.capacity;
  }
  return sum;
}

/// The least cost over all ways to share out the nodes without a terminal.
double least_cost(const std::vector<Terminal>& nodes, const std::vector<CutEdge>& edges) {
  std::vector<Index> free;
  std::vector<bool> beyond(nodes.size());
  for (Index i = 0; i < static_cast<Index>(nodes.size()); ++i) {
    if (nodes[i] == Terminal::none) free.push_back(i);
    beyond[i] = nodes[i] == Terminal::sink;
  }
  double least = 1e300;
  for (std::uint32_t choice = 0; choice < 1u << free.size(); ++choice) {
    for (std::size_t k = 0; k < free.size(); ++k) beyond[free[k]] = choice >> k & 1u;
    least = std::min(least, cost(beyond, edges));
  }
  return least;
}

TEST_CASE("the cut through bands of 30 faces is as cheap as the best of all") {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    // Three rows of ten faces around a dented tube; every other face of the outer rows is tied.
    test::Mesh mesh = test::tube(5, 4);
    test::Random random(seed);
    for (double& x : mesh.positions) x += 0.15 * random.number();
    const auto shape = test::shape_of(mesh);
    const Points& points = shape->points();
    const Triangles& triangles = shape->triangles();
    REQUIRE(triangles.cols() == 30);
    std::vector<CutEdge> edges;
    for_each_edge(triangles, triangles_of_points(triangles, 20), [&](Index a, Index b, std::span<const Index> sharing) {
      if (sharing.size() != 2) return;
      const auto third = [&](Index t) { return triangles.col(t).sum() - a - b; };
      // Corner order does not matter to the oracle: any costs do.
      edges.push_back(
          {sharing[0], sharing[1],
           cut_cost(points.col(a), points.col(b), points.col(third(sharing[0])), points.col(third(sharing[1])))});
    });
    std::vector<Terminal> nodes(30, Terminal::none);
    for (Index t = 0; t < 10; t += 2) {
      nodes[t] = Terminal::source;
      nodes[20 + t] = Terminal::sink;
    }
    // The remaining 20 are free: a million ways. Half of them are tied at random to keep it short.
    for (Index t = 0; t < 6; ++t) {
      Terminal& node = nodes[1 + 2 * random.below(15)];
      if (node == Terminal::none) node = random.number() < 0 ? Terminal::source : Terminal::sink;
    }
    const std::vector<bool> beyond = min_cut(nodes, edges);
    for (Index t = 0; t < 30; ++t) {
      if (nodes[t] != Terminal::none) CHECK(beyond[t] == (nodes[t] == Terminal::sink));
    }
    CHECK(cost(beyond, edges) == doctest::Approx(least_cost(nodes, edges)).epsilon(1e-8));
  }
}

TEST_CASE("edges without cost, and no edges, are cut too") {
  const std::vector<Terminal> nodes{Terminal::source, Terminal::none, Terminal::sink};
  CHECK(min_cut(nodes, {}) == std::vector<bool>{false, true, true});
  const std::vector<CutEdge> edges{{0, 1, 2.0}, {1, 2, 0.0}};
  CHECK(min_cut(nodes, edges) == std::vector<bool>{false, false, true});
}

TEST_CASE("creases are cheaper to cut along, inward ones most") {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const double flat = cut_cost(a, b, c, {0, -1, 0});
  const double outward = cut_cost(a, b, c, {0, -1, -1});
  const double inward = cut_cost(a, b, c, {0, -1, 1});
  CHECK(flat == doctest::Approx(1.0));
  CHECK(outward == doctest::Approx(1.0 - 0.2 / 4));
  CHECK(inward == doctest::Approx(1.0 - 1.0 / 4));
  CHECK(cut_cost(a, b, c, {0, 1, 1e-9}) > 0.0);
}

}  // namespace
}  // namespace pliant
