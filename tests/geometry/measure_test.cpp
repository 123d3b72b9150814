#include "pliant/geometry/measure.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/triangle_crossing.h"
#include "support/shapes.h"

namespace pliant {
namespace {

constexpr double pi = std::numbers::pi;

template <class Map>
Points mapped(const Points& points, Map map) {
  Points result = points;
  for (auto p : result.colwise()) {
    p = map(Eigen::Vector3d(p));
  }
  return result;
}

Eigen::Matrix3d corners(const Points& points, const Triangles& triangles, Index t) {
  return points(Eigen::all, triangles.col(t));
}

Index crossings_of_all_pairs(const Shape& shape, const Points& points) {
  const Triangles& triangles = shape.triangles();
  Index count = 0;
  for (Index s = 0; s < triangles.cols(); ++s) {
    for (Index t = s + 1; t < triangles.cols(); ++t) {
      bool shared = false;
      for (const Index corner : triangles.col(s)) {
        shared |= (triangles.col(t).array() == corner).any();
      }
      count += !shared && triangles_cross(corners(points, triangles, s), corners(points, triangles, t), 1e-10);
    }
  }
  return count;
}

TEST_CASE("a rigid motion changes nothing") {
  const test::Mesh pair =
      test::both(test::sphere(2), test::transformed(test::potato(2), 0.7, Eigen::Matrix3d::Identity(),
                                                    {0.5, 0.1, 0.0}));  // crosses the sphere, before and after
  // Boxes side by side: their sides touch without sharing all vertices.
  const test::Mesh stacked =
      test::both(test::box(1, 1, 1, 0.5),
                 test::transformed(test::box(1, 1, 1, 0.25), 1.0, Eigen::Matrix3d::Identity(), {1.0, 0.1, 0.1}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const test::Mesh& mesh : {pair, stacked, test::bumpy_plane(21, 2, 0.1)}) {
    const auto shape = test::shape_of(mesh);
    const Quality quality = measure_quality(*shape, mapped(shape->points(), [&](const auto& p) {
      return Eigen::Vector3d(turn * p + Eigen::Vector3d(5, -3, 2));
    }));
    CHECK(quality.stretch_max < 1e-12);
    CHECK(quality.shear < 1e-10);
    REQUIRE(quality.area.has_value());
    CHECK(*quality.area == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(quality.folds == 0);
    CHECK(quality.intersections == 0);
    CHECK(quality.roughness == doctest::Approx(quality.roughness_rest).epsilon(1e-10));
    CHECK(quality.volume.has_value() == (shape->report().boundary_edges == 0));
  }
}

TEST_CASE("a sphere of twice the size: volume 8, area 4, edges twice as long, same angles") {
  const auto shape = test::shape_of(test::sphere(2));
  const Quality quality = measure_quality(*shape, 2.0 * shape->points());
  CHECK(quality.volume.value() == doctest::Approx(8.0).epsilon(1e-12));
  CHECK(quality.area.value() == doctest::Approx(4.0).epsilon(1e-12));
  CHECK(quality.stretch_mean == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(quality.stretch_p95 == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(quality.stretch_max == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(quality.shear < 1e-10);
  CHECK(quality.roughness == doctest::Approx(2.0 * quality.roughness_rest).epsilon(1e-12));
}

TEST_CASE("turned inside out a sphere has volume -1") {
  const auto shape = test::shape_of(test::sphere(1));
  CHECK(measure_quality(*shape, -shape->points()).volume.value() == doctest::Approx(-1.0).epsilon(1e-12));
}

TEST_CASE("a plane bent into a half circle keeps lengths, angles and area") {
  const auto shape = test::shape_of(test::plane_grid(201, 21, 1.0, 0.1));
  const Points bent = mapped(shape->points(), [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(std::sin(pi * p.x()) / pi, p.y(), (1 - std::cos(pi * p.x())) / pi);
  });
  const Quality quality = measure_quality(*shape, bent);
  // A chord of an arc of h = pi / 200 is shorter by h^2 / 24.
  CHECK(quality.stretch_max == doctest::Approx(std::pow(pi / 200, 2) / 24).epsilon(0.01));
  CHECK(quality.shear < 1e-3);
  CHECK(quality.area.value() == doctest::Approx(1.0).epsilon(1e-4));
  CHECK(!quality.volume.has_value());
  CHECK(quality.folds == 0);
  CHECK(quality.intersections == 0);
  CHECK(quality.roughness_rest == 0.0);
  CHECK(quality.roughness > 0.0);
}

TEST_CASE("stretch is told by its mean, its 95th percentile and its maximum") {
  // 21 separate triangles, the i-th scaled by 1 + i / 100: each i / 100 is the stretch of three
  // edges.
  test::Mesh mesh;
  Points deformed(3, 63);
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector3d at(3.0 * i, 0, 0);
    for (const Eigen::Vector3d& corner :
         {at, Eigen::Vector3d(at + Eigen::Vector3d(1, 0, 0)), Eigen::Vector3d(at + Eigen::Vector3d(0, 1, 0))}) {
      const auto v = static_cast<std::uint32_t>(mesh.vertices());
      mesh.triangles.push_back(v);
      mesh.positions.insert(mesh.positions.end(), {corner.x(), corner.y(), corner.z()});
      deformed.col(v) = at + (1 + i / 100.0) * (corner - at);
    }
  }
  const Quality quality = measure_quality(*test::shape_of(mesh), deformed);
  CHECK(quality.stretch_mean == doctest::Approx(0.1));
  CHECK(quality.stretch_max == doctest::Approx(0.2));
  // Place 0.95 * 62 = 58.9 of the sorted 63: between two values of 0.19.
  CHECK(quality.stretch_p95 == doctest::Approx(0.19));
}

TEST_CASE("shear is the mean change of the corner angles") {
  const test::Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  Points deformed(3, 3);
  deformed << 0, 1, 0.5,         //
      0, 0, std::sqrt(3.0) / 2,  //
      0, 0, 0;
  // 90, 45, 45 degrees become 60 each: changes of 30, 15 and 15.
  CHECK(measure_quality(*test::shape_of(mesh), deformed).shear == doctest::Approx(20.0));
}

TEST_CASE("a folded strip counts the edges of its folds") {
  const auto shape = test::shape_of(test::plane_grid(31, 5, 3.0, 0.4));
  const auto folded = [&](double angle) {
    // Up at x = 1 by the angle, back to level at x = 2: two folds across four cells each.
    return mapped(shape->points(), [&](const Eigen::Vector3d& p) {
      const double up = std::clamp(p.x() - 1.0, 0.0, 1.0);
      const double level = std::min(p.x(), 1.0) + std::max(p.x() - 2.0, 0.0);
      return Eigen::Vector3d(level + up * std::cos(angle), p.y(), up * std::sin(angle));
    });
  };
  CHECK(measure_quality(*shape, folded(150 * pi / 180)).folds == 8);
  CHECK(measure_quality(*shape, folded(121 * pi / 180)).folds == 8);
  CHECK(measure_quality(*shape, folded(119 * pi / 180)).folds == 0);
}

TEST_CASE("folds and crossings the rest shape has are not new") {
  const test::Mesh open = test::plane_grid(3, 2);
  const auto flat = test::shape_of(open);
  const Points closed = mapped(flat->points(), [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(0.5 - std::abs(p.x() - 0.5), p.y(), std::max(p.x() - 0.5, 0.0) * 0.01);
  });
  CHECK(measure_quality(*flat, closed).folds == 1);
  test::Mesh book = open;
  std::copy(closed.data(), closed.data() + closed.size(), book.positions.begin());
  CHECK(measure_quality(*test::shape_of(book), closed).folds == 0);
}

TEST_CASE("two spheres pushed into each other cross where a loop over all pairs says so") {
  const test::Mesh apart = test::both(
      test::sphere(2), test::transformed(test::sphere(2), 0.9, Eigen::Matrix3d::Identity(), {2.0, 0.1, 0.05}));
  const auto shape = test::shape_of(apart);
  const Points pushed = mapped(shape->points(), [](const Eigen::Vector3d& p) {
    return p.x() > 1.01 ? Eigen::Vector3d(p - Eigen::Vector3d(0.8, 0, 0)) : p;
  });
  const Index expected = crossings_of_all_pairs(*shape, pushed);
  CHECK(expected > 20);
  CHECK(crossings_of_all_pairs(*shape, shape->points()) == 0);
  CHECK(measure_quality(*shape, pushed).intersections == expected);
  CHECK(measure_quality(*shape, pushed, false).intersections == 0);
}

TEST_CASE("a flat shape folded over itself in its own plane crosses") {
  const auto shape = test::shape_of(test::plane_grid(9, 3));
  const Points folded = mapped(shape->points(), [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(0.53 - std::abs(p.x() - 0.5), p.y(), 0.0);
  });
  CHECK(measure_quality(*shape, folded).intersections == crossings_of_all_pairs(*shape, folded));
  CHECK(measure_quality(*shape, folded).intersections > 10);
}

TEST_CASE("volume needs a closed, consistently oriented surface") {
  test::Mesh mesh = test::sphere(1);
  CHECK(measure_quality(*test::shape_of(mesh), test::shape_of(mesh)->points()).volume.has_value());
  std::swap(mesh.triangles[0], mesh.triangles[1]);
  CHECK(!measure_quality(*test::shape_of(mesh), test::shape_of(mesh)->points()).volume.has_value());
}

TEST_CASE("collapsed and triangle-free shapes have finite measures") {
  const auto shape = test::shape_of(test::sphere(1));
  const Quality collapsed = measure_quality(*shape, Points::Zero(3, shape->points().cols()));
  CHECK(collapsed.stretch_mean == 1.0);
  CHECK(collapsed.volume.value() == 0.0);
  CHECK(collapsed.area.value() == 0.0);
  CHECK(std::isfinite(collapsed.shear));
  CHECK(collapsed.folds == 0);
  CHECK(collapsed.intersections == 0);
  CHECK(collapsed.roughness == 0.0);

  const test::Mesh cloud{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {}};
  const Quality quality = measure_quality(*test::shape_of(cloud), Points::Random(3, 3));
  CHECK(quality.stretch_max == 0.0);
  CHECK(!quality.area.has_value());
  CHECK(!quality.volume.has_value());
}

TEST_CASE("the enclosed volume is signed, and there only where something is bounded") {
  const auto volume = [](const test::Mesh& mesh) { return enclosed_volume(*test::shape_of(mesh)); };
  CHECK(volume(test::box(1, 2, 3, 0.5)).value() == doctest::Approx(6.0));
  CHECK(volume(test::soup(test::sphere(5))).value() == doctest::Approx(4.0 / 3.0 * pi).epsilon(0.01));
  test::Mesh inside_out = test::box(1, 2, 3, 0.5);
  for (std::size_t t = 0; t < inside_out.triangles.size(); t += 3)
    std::swap(inside_out.triangles[t], inside_out.triangles[t + 1]);
  CHECK(volume(inside_out).value() == doctest::Approx(-6.0));
  CHECK_FALSE(volume(test::tube(12, 5)).has_value());
  CHECK_FALSE(volume(test::plane_grid(4, 4)).has_value());
  CHECK_FALSE(volume({test::sphere(1).positions, {}}).has_value());
}

}  // namespace
}  // namespace pliant
