#include "pliant/deformers/embedded_graph/graph.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "support/shapes.h"

using namespace pliant;

namespace {

/// Eq. 4 by sorting all nodes: the slow oracle. Returns a dense row of m weights.
Eigen::VectorXd slow_weights(const Points& nodes, const Eigen::Vector3d& p, int k) {
  std::vector<std::pair<double, Index>> order;
  for (Index j = 0; j < nodes.cols(); ++j) order.push_back({(nodes.col(j) - p).norm(), j});
  std::sort(order.begin(), order.end());
  const double d_max = k < nodes.cols() ? order[k].first : 2.0 * order[static_cast<std::size_t>(k) - 1].first;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(nodes.cols());
  for (int s = 0; s < k; ++s) {
    weights[order[s].second] = std::pow(1.0 - order[s].first / d_max, 2);
  }
  return weights / weights.sum();
}

Eigen::VectorXd dense_row(const Influences& influences, Index point, Index nodes) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(nodes);
  for (int s = 0; s < influences.k; ++s) {
    const std::size_t at = static_cast<std::size_t>(point) * influences.k + s;
    row[influences.indices[at]] += influences.weights[at];
  }
  return row;
}

DeformationGraph graph_of(const Shape& shape, EmbeddedGraphOptions options) {
  return build_graph(shape, *place_nodes(shape, options), options);
}

}  // namespace

TEST_CASE("weights are those of eq. 4, whatever k") {
  const auto shape = test::shape_of(test::potato(3));
  for (int k : {1, 3, 4, 8, 40}) {
    const DeformationGraph graph = graph_of(*shape, {.node_count = 40, .neighbours = k});
    for (Index i = 0; i < shape->points().cols(); i += 7) {
      const Eigen::VectorXd row = dense_row(graph.influences, i, 40);
      CHECK((row - slow_weights(graph.nodes, shape->points().col(i), k)).norm() < 1e-12);
    }
  }
}

TEST_CASE("edges join exactly the nodes that influence a common point") {
  const auto shape = test::shape_of(test::torus(40, 20));
  const DeformationGraph graph = graph_of(*shape, {.node_count = 60});
  std::set<Edge> expected;
  for (Index i = 0; i < shape->points().cols(); ++i) {
    const Eigen::VectorXd row = dense_row(graph.influences, i, 60);
    for (Index j = 0; j < 60; ++j) {
      for (Index k = j + 1; k < 60; ++k) {
        if (row[j] > 0.0 && row[k] > 0.0) expected.insert({j, k});
      }
    }
  }
  CHECK(std::vector<Edge>(expected.begin(), expected.end()) == graph.edges);
  double mean = 0.0;
  for (const auto& [j, k] : graph.edges) mean += (graph.nodes.col(j) - graph.nodes.col(k)).norm();
  CHECK(graph.length_unit == doctest::Approx(mean / static_cast<double>(graph.edges.size())));
}

TEST_CASE("degenerate layouts have defined weights") {
  const auto shape = test::shape_of(test::plane_grid(3, 3));
  SUBCASE("one node") {
    const DeformationGraph graph = graph_of(*shape, {.sampling = NodeSampling::nodes, .nodes = Points::Zero(3, 1)});
    CHECK(graph.influences.k == 1);
    for (double w : graph.influences.weights) CHECK(w == 1.0);
    CHECK(graph.edges.empty());
    CHECK(graph.length_unit == doctest::Approx(shape->diagonal()));
  }
  SUBCASE("all nodes in one place, on a point: equal weights") {
    const DeformationGraph graph =
        graph_of(*shape, {.sampling = NodeSampling::nodes, .nodes = Points::Zero(3, 6), .neighbours = 4});
    for (int s = 0; s < 4; ++s) CHECK(graph.influences.weights[s] == 0.25);
    CHECK(graph.length_unit > 0.0);
  }
  SUBCASE("nodes at equal distance: equal weights") {
    Points nodes(3, 4);
    nodes << 1, -1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0;
    const auto centre = Shape::create(std::vector<double>{0, 0, 0}, {});
    REQUIRE(centre.ok());
    const DeformationGraph graph =
        graph_of(**centre, {.sampling = NodeSampling::nodes, .nodes = nodes, .neighbours = 3});
    for (double w : graph.influences.weights) CHECK(w == doctest::Approx(1.0 / 3.0));
  }
}

TEST_CASE("a cut keeps two sheets that nearly touch apart") {
  // Two parallel sheets, closer to each other than their nodes are apart.
  const auto shape = test::shape_of(
      test::both(test::plane_grid(15, 15),
                 test::transformed(test::plane_grid(15, 15), 1.0, Eigen::Matrix3d::Identity(), {0, 0, 0.02})));
  Cut cut;
  for (Index v = 0; v < 450; ++v) (v < 225 ? cut.a : cut.b).push_back(v);
  EmbeddedGraphOptions options{.node_count = 50};
  auto crossing = [&](const DeformationGraph& graph) {
    double across = 0.0;
    for (Index i = 0; i < 450; ++i) {
      for (int s = 0; s < graph.influences.k; ++s) {
        const std::size_t at = static_cast<std::size_t>(i) * graph.influences.k + s;
        const bool node_above = graph.nodes(2, graph.influences.indices[at]) > 0.01;
        if (node_above != (i >= 225)) across += graph.influences.weights[at];
      }
    }
    for (const auto& [j, k] : graph.edges) {
      if ((graph.nodes(2, j) > 0.01) != (graph.nodes(2, k) > 0.01)) across += 1.0;
    }
    return across;
  };
  CHECK(crossing(graph_of(*shape, options)) > 1.0);
  options.cuts = {cut};
  const DeformationGraph graph = graph_of(*shape, options);
  CHECK(crossing(graph) == 0.0);
  // Points from elsewhere follow the side they are nearest to.
  Points probe(3, 2);
  probe << 0.3, 0.3, 0.3, 0.3, -0.001, 0.021;
  const Influences carried = compute_influences(*shape, graph, probe);
  for (int s = 0; s < carried.k; ++s) {
    CHECK(graph.nodes(2, carried.indices[s]) < 0.01);
    CHECK(graph.nodes(2, carried.indices[carried.k + s]) > 0.01);
  }
}

TEST_CASE("bad options are refused by name") {
  const auto shape = test::shape_of(test::plane_grid(4, 4));
  const auto points = Shape::create(std::vector<double>{0, 0, 0, 1, 0, 0}, {});
  REQUIRE(points.ok());
  auto message = [](const Shape& s, const EmbeddedGraphOptions& options) {
    const Status status = options.validate(s);
    CHECK(status.code() == ErrorCode::invalid_option);
    return status.message();
  };
  using doctest::Contains;
  CHECK(message(*shape, {.node_count = 17}).c_str() == Contains("nodeCount is 17"));
  CHECK(message(*shape, {.node_count = -3}).c_str() == Contains("nodeCount is -3"));
  CHECK(message(*shape, {.node_count = 5, .neighbours = 6}).c_str() == Contains("neighbours is 6"));
  CHECK(message(*shape, {.sampling = NodeSampling::nodes}).c_str() == Contains("nodes is empty"));
  CHECK(message(*shape, {.node_count = 2, .sampling = NodeSampling::nodes, .nodes = Points::Zero(3, 2)}).c_str() ==
        Contains("nodeCount"));
  CHECK(message(*shape, {.rotation_weight = 0.0}).c_str() == Contains("rotationWeight"));
  CHECK(message(*shape, {.constraint_weight = -1.0}).c_str() == Contains("constraintWeight"));
  CHECK(message(*shape, {.cuts = {{{0}, {0}}}}).c_str() == Contains("both sides"));
  CHECK(message(*shape, {.cuts = {{{0}, {}}}}).c_str() == Contains("empty selection"));
  CHECK(message(*shape, {.cuts = {{{0}, {99}}}}).c_str() == Contains("vertex 99"));
  CHECK(message(**points, {.sampling = NodeSampling::simplify}).c_str() == Contains("no triangles"));
  CHECK(EmbeddedGraphOptions{}.validate(*shape).ok());
}
