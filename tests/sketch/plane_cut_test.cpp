// Must show 3 of the issue: exactly two parts, a minimal set of loops, a natural boundary.
#include "pliant/sketch/plane_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/adjacency.h"
#include "sketch/sketch_support.h"
#include "support/random.h"

namespace pliant {
namespace {

/// A cut of a whole shape by the plane n.x = offset, along the loop nearest to a point.
struct Cut {
  std::shared_ptr<const Shape> shape;
  std::vector<double> distance;
  std::vector<Index> all;
  std::unique_ptr<PlaneCut> cut;

  Cut(const test::Mesh& mesh, const Eigen::Vector3d& normal, double offset) : shape(test::shape_of(mesh)) {
    for (const auto& p : shape->points().colwise()) distance.push_back(normal.dot(p) - offset);
    all.resize(shape->triangles().cols());
    std::iota(all.begin(), all.end(), 0);
    cut = std::make_unique<PlaneCut>(shape->points(), shape->triangles(), all, distance);
  }

  Index nearest(const Eigen::Vector3d& p) const {
    Index best = 0;
    double least = 1e300;
    for (Index l = 0; l < static_cast<Index>(cut->loops().size()); ++l) {
      const double d = (cut->loops()[l].crossings.colwise() - p).colwise().squaredNorm().minCoeff();
      if (d < least) least = d, best = l;
    }
    return best;
  }

  /// Parts connected through edges, of one side.
  int parts(const std::vector<CutSide>& sides, CutSide side) const {
    std::vector<Index> chosen;
    for (const Index t : all) {
      if (sides[t] == side) chosen.push_back(t);
    }
    const Triangles part = shape->triangles()(Eigen::all, chosen);
    const Index points = static_cast<Index>(shape->points().cols());
    const Components found = connected_components(part, triangles_of_points(part, points));
    return chosen.empty() ? 0 : *std::max_element(found.of_triangle.begin(), found.of_triangle.end()) + 1;
  }

  /// The sum of the angles by which the boundary between the sides turns.
  double turning(const std::vector<CutSide>& sides) const {
    std::map<Index, std::vector<Index>> next;
    const Triangles& triangles = shape->triangles();
    for_each_edge(triangles, triangles_of_points(triangles, static_cast<Index>(shape->points().cols())),
                  [&](Index a, Index b, std::span<const Index> sharing) {
                    if (sharing.size() == 2 && sides[sharing[0]] != sides[sharing[1]]) {
                      next[a].push_back(b);
                      next[b].push_back(a);
                    }
                  });
    double sum = 0.0;
    for (const auto& [p, others] : next) {
      if (others.size() != 2) continue;
      const Eigen::Vector3d u = shape->points().col(p) - shape->points().col(others[0]);
      const Eigen::Vector3d v = shape->points().col(others[1]) - shape->points().col(p);
      sum += std::atan2(u.cross(v).norm(), u.dot(v));
    }
    return sum;
  }
};

TEST_CASE("a torus is cut along both loops, whichever is nearest") {
  for (const double x : {1.0, -1.0}) {
    Cut torus(test::torus(48, 24), Eigen::Vector3d::UnitY(), 0.01);
    REQUIRE(torus.cut->loops().size() == 2);
    CHECK(torus.cut->separate(torus.nearest({x, 0, 0})).size() == 2);
    const std::vector<CutSide> sides = torus.cut->sides(0.05);
    CHECK(torus.parts(sides, CutSide::behind) == 1);
    CHECK(torus.parts(sides, CutSide::ahead) == 1);
    CHECK(torus.parts(sides, CutSide::outside) == 0);
  }
}

/// A slab with two holes: genus 2, and three bars across the middle.
test::Mesh double_torus() {
  return test::cells(15, 9, 3,
                     [](int x, int y, int) { return !(y >= 3 && y < 6 && ((x >= 3 && x < 6) || (x >= 9 && x < 12))); });
}

TEST_CASE("genus 2: loops are dropped only while the two parts stay two") {
  // Along the slab: three bars, all needed.
  Cut lengthwise(double_torus(), Eigen::Vector3d::UnitY(), 4.4);
  REQUIRE(lengthwise.cut->loops().size() == 3);
  CHECK(lengthwise.cut->separate(lengthwise.nearest({0, 4.4, 1})).size() == 3);
  // Across a hole: two loops, both needed; between the holes: one is all there is.
  for (const double x : {4.4, 10.4}) {
    Cut across(double_torus(), Eigen::Vector3d::UnitX(), x);
    REQUIRE(across.cut->loops().size() == 2);
    CHECK(across.cut->separate(0).size() == 2);
    CHECK(across.parts(across.cut->sides(0.3), CutSide::behind) == 1);
    CHECK(across.parts(across.cut->sides(0.3), CutSide::ahead) == 1);
  }
  Cut between(double_torus(), Eigen::Vector3d::UnitX(), 7.4);
  REQUIRE(between.cut->loops().size() == 1);
  CHECK(between.cut->separate(0).size() == 1);

  // A comb on a ring: of the teeth only the chosen one is cut.
  const test::Mesh comb = test::cells(9, 6, 2, [](int x, int y, int) { return y < 2 || x % 2; });
  Cut teeth(comb, Eigen::Vector3d::UnitY(), 3.4);
  REQUIRE(teeth.cut->loops().size() == 4);
  const Index first = teeth.nearest({3.5, 3.4, 0});
  CHECK(teeth.cut->separate(first) == std::vector<Index>{first});
  const std::vector<CutSide> sides = teeth.cut->sides(0.3);
  CHECK(teeth.parts(sides, CutSide::behind) == 1);
  CHECK(teeth.parts(sides, CutSide::ahead) == 1);
}

TEST_CASE("other components stay outside") {
  const test::Mesh two =
      test::both(test::sphere(3), test::transformed(test::sphere(3), 1.0, Eigen::Matrix3d::Identity(), {5, 0, 0}));
  Cut cut(two, Eigen::Vector3d::UnitY(), 0.01);
  REQUIRE(cut.cut->loops().size() == 2);
  cut.cut->separate(cut.nearest({1, 0, 0}));
  const std::vector<CutSide> sides = cut.cut->sides(0.1);
  const Components components =
      connected_components(cut.shape->triangles(),
                           triangles_of_points(cut.shape->triangles(), static_cast<Index>(cut.shape->points().cols())));
  for (const Index t : cut.all) {
    CHECK((sides[t] == CutSide::outside) == (components.of_triangle[t] == 1));
  }
}

TEST_CASE("a part known to be one component is parted as if it had been searched") {
  const Cut tube(test::cylinder(24, 30, 0.1), Eigen::Vector3d::UnitZ(), 0.4);
  REQUIRE(tube.cut->loops().size() == 1);
  const Cut ring(test::torus(48, 24), Eigen::Vector3d::UnitY(), 0.01);
  REQUIRE(ring.cut->loops().size() == 2);
  for (const Cut* shape : {&tube, &ring}) {
    for (const double band : {0.0, 0.05}) {
      const std::vector<Index> searched = shape->cut->separate(0);
      const std::vector<CutSide> plane = shape->cut->sides_of_plane(), sides = shape->cut->sides(band);
      CHECK(shape->cut->separate(0, true) == searched);
      CHECK(shape->cut->sides_of_plane() == plane);
      CHECK(shape->cut->sides(band) == sides);
      CHECK(shape->parts(plane, CutSide::behind) == 1);
      CHECK(shape->parts(plane, CutSide::ahead) == 1);
    }
  }
}

TEST_CASE("the cheapest boundary turns less than the plane's") {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    test::Mesh mesh = test::potato(4);
    test::Random random(seed);
    const Eigen::Vector3d normal =
        (Eigen::Vector3d::UnitX() + 0.4 * Eigen::Vector3d(random.number(), random.number(), random.number()))
            .normalized();
    Cut cut(mesh, normal, 0.2);
    cut.cut->separate(0);
    const double plane = cut.turning(cut.cut->sides(0.0)), best = cut.turning(cut.cut->sides(0.15));
    CHECK(best < plane);
  }
}

TEST_CASE("a band that swallows one side leaves the plane's cut") {
  Cut cut(test::sphere(3), Eigen::Vector3d::UnitZ(), 0.9);
  cut.cut->separate(0);
  const std::vector<CutSide> sides = cut.cut->sides(0.5);
  CHECK(cut.parts(sides, CutSide::ahead) == 1);
  CHECK(cut.parts(sides, CutSide::behind) == 1);
}

}  // namespace
}  // namespace pliant
