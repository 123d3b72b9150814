#include "pliant/geometry/bvh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

Pairs all_pairs(const Points& points, const Triangles& triangles) {
  const auto box = [&](Index t) {
    Eigen::AlignedBox3d result;
    for (const Index corner : triangles.col(t)) {
      result.extend(points.col(corner));
    }
    return result;
  };
  Pairs pairs;
  for (Index s = 0; s < triangles.cols(); ++s) {
    for (Index t = s + 1; t < triangles.cols(); ++t) {
      if (box(s).intersects(box(t))) {
        pairs.emplace_back(s, t);
      }
    }
  }
  return pairs;
}

Pairs tree_pairs(const Points& points, const Triangles& triangles) {
  Pairs pairs;
  Bvh(points, triangles).for_each_touching_pair([&](Index s, Index t) { pairs.emplace_back(s, t); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST_CASE("the tree finds the pairs a loop over all finds, each once") {
  const test::Mesh inside = test::transformed(test::potato(2), 0.8);
  const test::Mesh grid = test::plane_grid(12, 9);  // many boxes that only touch
  test::Mesh coincident = test::both(test::sphere(0), test::sphere(0));
  for (const test::Mesh& mesh :
       {test::both(test::sphere(2), inside), grid, coincident, test::torus(20, 10), test::Mesh{{0, 0, 0}, {}}}) {
    const auto shape = test::shape_of(mesh);
    CHECK(tree_pairs(shape->points(), shape->triangles()) == all_pairs(shape->points(), shape->triangles()));
  }
}

}  // namespace
}  // namespace pliant
