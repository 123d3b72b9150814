#include "pliant/geometry/simplify.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

Points survivors(const test::Mesh& mesh, Index target) {
  const auto shape = test::shape_of(mesh);
  const auto kept = simplify(*shape, {.target_points = target});
  REQUIRE(kept.ok());
  return shape->points()(Eigen::all, *kept);
}

double distance_to_nearest(const Points& points, const Eigen::Vector3d& p) {
  return (points.colwise() - p).colwise().norm().minCoeff();
}

double largest_difference(const Points& a, const Points& b) {
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff();
}

/// A sphere with a fin along one edge, a cube beside it, both sides of a square, and a lone point.
test::Mesh odds_and_ends() {
  test::Mesh mesh = test::sphere(1);
  const std::uint32_t tip = static_cast<std::uint32_t>(mesh.vertices());
  mesh.positions.insert(mesh.positions.end(), {0.0, 3.0, 0.0});
  mesh.triangles.insert(mesh.triangles.end(), {mesh.triangles[0], mesh.triangles[1], tip});
  mesh = test::both(mesh, test::transformed(test::box(1, 1, 1, 1), 0.5, Eigen::Matrix3d::Identity(), {4.0, 0.0, 0.0}));
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.vertices());
  mesh = test::both(mesh, test::transformed(test::plane_grid(2, 2), 1.0, Eigen::Matrix3d::Identity(), {0.0, 0.0, 7.0}));
  mesh.triangles.insert(mesh.triangles.end(), {first, first + 3, first + 1, first, first + 2, first + 3});
  mesh.positions.insert(mesh.positions.end(), {9.0, 9.0, 9.0});
  return mesh;
}

TEST_CASE("exactly as many distinct points survive as asked for, down to one") {
  for (const test::Mesh& mesh : {odds_and_ends(), test::tube(8, 5), test::torus(8, 5), test::plane_grid(6, 5)}) {
    const auto shape = test::shape_of(mesh);
    for (Index target = 1; target <= shape->points().cols(); ++target) {
      const auto kept = simplify(*shape, {.target_points = target});
      REQUIRE(kept.ok());
      CHECK(std::set<Index>(kept->begin(), kept->end()).size() == static_cast<std::size_t>(target));
    }
  }
}

TEST_CASE("bad options are refused by name") {
  const auto shape = test::shape_of(test::sphere(0));
  const auto refused = [](const Shape& s, const SimplifyOptions& options) {
    const auto kept = simplify(s, options);
    REQUIRE(!kept.ok());
    CHECK(kept.status().code() == ErrorCode::invalid_option);
    return kept.status().message();
  };
  CHECK(refused(*shape, {.target_points = 0}) == "target_points is 0; expected 1 to 12, the points of the shape");
  CHECK(refused(*shape, {.target_points = 13}).starts_with("target_points is 13"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double limit : {1.0, -5.0, nan}) {
    CHECK(refused(*shape, {.target_points = 8, .max_aspect_ratio = limit}).starts_with("max_aspect_ratio is "));
  }
  const test::Mesh cloud{{0, 0, 0, 1, 1, 1}, {}};
  CHECK(refused(*test::shape_of(cloud), {.target_points = 1}).starts_with("shape has no triangles"));
}

TEST_CASE("survivors are spread evenly") {
  for (const test::Mesh& mesh :
       {test::potato(4), test::bumpy_plane(41, 4, 0.02), test::plane_grid(41, 41), test::torus(60, 30)}) {
    const Points kept = survivors(mesh, 120);
    double least = std::numeric_limits<double>::infinity();
    double mean = 0.0;
    for (Index i = 0; i < kept.cols(); ++i) {
      Points others = kept;
      others.col(i).setConstant(1e9);
      const double nearest = distance_to_nearest(others, kept.col(i));
      least = std::min(least, nearest);
      mean += nearest / static_cast<double>(kept.cols());
    }
    CHECK(least > 0.4 * mean);
    const auto shape = test::shape_of(mesh);
    for (Index p = 0; p < shape->points().cols(); ++p) {
      CHECK(distance_to_nearest(kept, shape->points().col(p)) < 2.0 * mean);
    }
  }
}

TEST_CASE("corners and boundaries stay") {
  const Points square = survivors(test::plane_grid(21, 21), 40);
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      CHECK(distance_to_nearest(square, {x, y, 0.0}) == 0.0);
    }
  }
  // Between the corners there are other points on the boundary.
  CHECK((square.row(0).array() == 0.0).count() > 3);

  const Points box = survivors(test::box(2, 1, 1, 0.125), 60);
  for (const double x : {0.0, 2.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double z : {0.0, 1.0}) {
        CHECK(distance_to_nearest(box, {x, y, z}) == 0.0);
      }
    }
  }
}

TEST_CASE("lone points go first") {
  test::Mesh mesh = test::sphere(1);
  for (int i = 0; i < 50; ++i) {
    mesh.positions.insert(mesh.positions.end(), {3.0 + i, 0.0, 0.0});
  }
  CHECK(survivors(mesh, 42).row(0).maxCoeff() <= 1.0);
  CHECK(survivors(mesh, 43).row(0).maxCoeff() > 2.0);
}

TEST_CASE("components share the survivors by area, and the smallest get none") {
  const auto apart = [](double scale, double x) {
    return test::transformed(test::sphere(2), scale, Eigen::Matrix3d::Identity(), {x, 0.0, 0.0});
  };
  // Areas 1, 1/4 and 1/10000.
  const test::Mesh mesh = test::both(test::both(apart(1.0, 0.0), apart(0.5, 5.0)), apart(0.01, 9.0));
  const Points kept = survivors(mesh, 50);
  CHECK((kept.row(0).array() < 2.0).count() == doctest::Approx(40).epsilon(0.15));
  CHECK((kept.row(0).array() > 8.0).count() == 0);
}

TEST_CASE("numbering does not matter, not even on symmetric shapes") {
  for (const test::Mesh& mesh :
       {test::potato(3), test::bumpy_plane(33, 4, 0.02), test::sphere(3), test::box(3, 1, 1, 0.25), odds_and_ends()}) {
    CHECK(largest_difference(survivors(mesh, 40), survivors(test::renumbered(mesh, 7), 40)) == 0.0);
  }
}

TEST_CASE("survivors move, turn and scale with the scene") {
  const test::Mesh mesh = test::potato(3);
  const Points rest = survivors(mesh, 60);
  const Eigen::Matrix3d turns[] = {Eigen::Matrix3d::Identity(),
                                   (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(),
                                   Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix()};
  for (const Eigen::Matrix3d& turn : turns) {
    for (const double scale : {0.01, 1.0, 100.0}) {
      const Eigen::Vector3d away = scale * Eigen::Vector3d(30, -70, 110);
      const Points moved = survivors(test::transformed(mesh, scale, turn, away), 60);
      CHECK(largest_difference(moved, Points(((scale * turn) * rest).colwise() + away)) < 1e-12 * scale);
    }
  }
}

TEST_CASE("a symmetric shape keeps its survivors when it is scaled and moved") {
  const test::Mesh mesh = test::bumpy_plane(33, 4, 0.02);
  const Eigen::Vector3d away(0.3, -0.7, 0.11);
  const Points moved = survivors(test::transformed(mesh, 0.01, Eigen::Matrix3d::Identity(), away), 40);
  CHECK(largest_difference(moved, Points((0.01 * survivors(mesh, 40)).colwise() + away)) < 1e-14);
}

TEST_CASE("a point with thousands of triangles is no burden") {
  const int count = 4000;
  test::Mesh fan{{0.0, 0.0, 0.0}, {}};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    fan.positions.insert(fan.positions.end(), {std::cos(angle), std::sin(angle), 0.0});
    fan.triangles.insert(fan.triangles.end(),
                         {0u, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>((i + 1) % count + 1)});
  }
  const Points kept = survivors(fan, 20);
  CHECK(kept.cols() == 20);
  CHECK(distance_to_nearest(kept, {1.0, 0.0, 0.0}) < 0.5);
}

}  // namespace
}  // namespace pliant
