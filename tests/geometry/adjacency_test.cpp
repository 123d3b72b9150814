#include "pliant/geometry/adjacency.h"

#include <doctest/doctest.h>

namespace pliant {
namespace {

/// Two triangles that share the edge 0-2, and two that share only point 3; point 6 is alone.
Triangles kite_and_bow() {
  Triangles triangles(3, 4);
  triangles << 0, 0, 3, 3,  //
      1, 2, 4, 8,           //
      2, 7, 5, 9;
  return triangles;
}

TEST_CASE("edges appear once, with their triangles") {
  const Triangles triangles = kite_and_bow();
  const EdgeTable edges = unique_edges(triangles, 10);
  // Two triangles with a common edge have five edges, two without one have six.
  REQUIRE(edges.size() == 11);
  REQUIRE(edges.triangles.rows() == 11);
  CHECK(edges.ends.front() == std::array<Index, 2>{0, 1});
  for (Index e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    CHECK(a < b);
    const bool shared = a == 0 && b == 2;
    REQUIRE(edges.triangles.row(e).size() == (shared ? 2 : 1));
    for (const Index t : edges.triangles.row(e)) {
      const auto corners = triangles.col(t);
      CHECK((corners.array() == a).any());
      CHECK((corners.array() == b).any());
    }
  }
}

TEST_CASE("points know their triangles") {
  const Incidence around = triangles_of_points(kite_and_bow(), 10);
  REQUIRE(around.rows() == 10);
  CHECK(around.row(6).empty());
  REQUIRE(around.row(3).size() == 2);
  CHECK(around.row(3)[0] == 2);
  CHECK(around.row(3)[1] == 3);
  CHECK(around.items.size() == 12);
}

TEST_CASE("components are joined by edges, not by single points; a lone point is one") {
  const Triangles triangles = kite_and_bow();
  const Components parts = connected_components(triangles, triangles_of_points(triangles, 10));
  CHECK(parts.of_triangle == std::vector<Index>{0, 0, 1, 2});
  CHECK(parts.count == 4);
}

}  // namespace
}  // namespace pliant
