#include "pliant/geometry/sampling.h"

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

double distance_to_nearest(const Points& samples, const Eigen::Vector3d& p) {
  return (samples.colwise() - p).colwise().norm().minCoeff();
}

struct Spread {
  double least = std::numeric_limits<double>::infinity();  ///< distance between two samples
  double mean = 0.0;                                       ///< distance to the nearest other sample
};

Spread spread_of(Points samples) {
  Spread spread;
  for (Index i = 0; i < samples.cols(); ++i) {
    const Eigen::Vector3d p = samples.col(i);
    samples.col(i).setConstant(1e9);
    const double nearest = distance_to_nearest(samples, p);
    samples.col(i) = p;
    spread.least = std::min(spread.least, nearest);
    spread.mean += nearest / static_cast<double>(samples.cols());
  }
  return spread;
}

double largest_difference(const Points& a, const Points& b) {
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff();
}

TEST_CASE("samples are as many as asked for, far apart, and leave no hole") {
  for (const test::Mesh& mesh : {test::potato(4), test::bumpy_plane(41, 4, 0.02), test::torus(48, 24),
                                 test::tube(40, 40), test::box(3, 1, 1, 0.5)}) {
    const auto shape = test::shape_of(mesh);
    const auto size = static_cast<Index>(shape->points().cols());
    for (const Index count : {10, 57, 200}) {
      const Points samples = sample_surface(*shape, std::min(count, size), 1);
      REQUIRE(samples.cols() == std::min(count, size));
      const Spread spread = spread_of(samples);
      CHECK(spread.least > 0.8 * spread.mean);
      for (Index p = 0; p < shape->points().cols(); ++p) {
        CHECK(distance_to_nearest(samples, shape->points().col(p)) < 1.6 * spread.mean);
      }
    }
  }
}

TEST_CASE("samples lie on the surface, not at its vertices") {
  const auto shape = test::shape_of(test::plane_grid(5, 5));
  const Points samples = sample_surface(*shape, 25, 1);
  CHECK(samples.row(2).isZero(0.0));
  CHECK(samples.topRows(2).minCoeff() >= 0.0);
  CHECK(samples.topRows(2).maxCoeff() <= 1.0);
  const Points corners = 4.0 * samples;
  CHECK((corners - Points(corners.array().round())).cwiseAbs().maxCoeff() > 0.1);
}

TEST_CASE("uneven triangles do not bias the samples") {
  // The left half of the strip has 200 times the triangles of the right half.
  const test::Mesh mesh = test::both(
      test::plane_grid(41, 21, 2.0, 1.0),
      test::transformed(test::plane_grid(3, 2, 2.0, 1.0), 1.0, Eigen::Matrix3d::Identity(), {2.0, 0.0, 0.0}));
  const Points samples = sample_surface(*test::shape_of(mesh), 300, 1);
  CHECK((samples.row(0).array() < 2.0).count() == doctest::Approx(150).epsilon(0.06));
}

TEST_CASE("numbering does not matter, not even on symmetric shapes") {
  for (const test::Mesh& mesh : {test::potato(3), test::bumpy_plane(33, 4, 0.02), test::sphere(3),
                                 test::box(3, 1, 1, 0.25), test::torus(24, 12)}) {
    test::Mesh other = test::renumbered(mesh, 7);
    for (const bool points_only : {false, true}) {
      test::Mesh a = mesh;
      test::Mesh b = other;
      if (points_only) {
        a.triangles.clear();
        b.triangles.clear();
      }
      CHECK(largest_difference(sample_surface(*test::shape_of(a), 80, 1), sample_surface(*test::shape_of(b), 80, 1)) <
            1e-14);
    }
  }
}

TEST_CASE("samples move, turn and scale with the scene") {
  const test::Mesh mesh = test::potato(3);
  const Points rest = sample_surface(*test::shape_of(mesh), 100, 1);
  const Eigen::Matrix3d turns[] = {Eigen::Matrix3d::Identity(),
                                   (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(),
                                   (Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished(),
                                   Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix()};
  for (const Eigen::Matrix3d& turn : turns) {
    for (const double scale : {0.01, 1.0, 100.0}) {
      const Eigen::Vector3d away = scale * Eigen::Vector3d(30, -70, 110);
      const Points moved = sample_surface(*test::shape_of(test::transformed(mesh, scale, turn, away)), 100, 1);
      const Points expected = ((scale * turn) * rest).colwise() + away;
      CHECK(largest_difference(moved, expected) < 1e-12 * scale);
    }
  }
}

TEST_CASE("a seed decides, and nothing else") {
  const auto shape = test::shape_of(test::potato(3));
  const Points first = sample_surface(*shape, 50, 1);
  CHECK(largest_difference(first, sample_surface(*shape, 50, 1)) == 0.0);
  CHECK(largest_difference(first, sample_surface(*shape, 50, 2)) > 0.01);
}

TEST_CASE("components share the samples by area") {
  const test::Mesh mesh = test::both(
      test::sphere(3), test::transformed(test::sphere(2), 0.5, Eigen::Matrix3d::Identity(), {5.0, 0.0, 0.0}));
  const Points samples = sample_surface(*test::shape_of(mesh), 200, 1);
  CHECK((samples.row(0).array() > 3.0).count() == doctest::Approx(40).epsilon(0.15));
}

TEST_CASE("a component worth a node gets one, however close to a larger one") {
  // Share of the area: 1.2 nodes of 60; three times closer to the sphere than the samples'
  // distance.
  const double radius = std::sqrt(1.2 / 60);
  const test::Mesh mesh =
      test::both(test::sphere(3),
                 test::transformed(test::sphere(2), radius, Eigen::Matrix3d::Identity(), {1.05 + radius, 0.0, 0.0}));
  const auto shape = test::shape_of(mesh);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Points samples = sample_surface(*shape, 60, seed);
    REQUIRE(samples.cols() == 60);
    CHECK((samples.row(0).array() > 1.01).any());
  }
}

TEST_CASE("without triangles the samples are among the points") {
  test::Mesh mesh = test::potato(3);
  mesh.triangles.clear();
  const auto shape = test::shape_of(mesh);
  const Points samples = sample_surface(*shape, 60, 1);
  const Spread spread = spread_of(samples);
  CHECK(spread.least > 0.75 * spread.mean);
  for (Index i = 0; i < samples.cols(); ++i) {
    CHECK(distance_to_nearest(shape->points(), samples.col(i)) == 0.0);
  }
}

TEST_CASE("all points can be asked for, and one") {
  test::Mesh mesh = test::plane_grid(9, 9);
  mesh.triangles.clear();
  const auto shape = test::shape_of(mesh);
  for (const Index count : {81, 80, 47, 1}) {
    const Points samples = sample_surface(*shape, count, 1);
    REQUIRE(samples.cols() == count);
    if (count > 1) {
      CHECK(spread_of(samples).least > 0.124);
    }
  }
}

TEST_CASE("shapes without area are sampled among their points") {
  const test::Mesh line{{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, {0, 1, 2, 1, 2, 3}};
  const Points samples = sample_surface(*test::shape_of(line), 4, 1);
  CHECK(spread_of(samples).least == 1.0);
  const test::Mesh dot{{4, 5, 6, 4, 5, 6}, {}};
  CHECK(sample_surface(*test::shape_of(dot), 1, 1).col(0) == Eigen::Vector3d(4, 5, 6));
}

TEST_CASE("far outliers and tight clusters still give the number asked for") {
  test::Mesh mesh = test::transformed(test::potato(3), 1e-12);
  mesh.triangles.clear();
  mesh.positions.insert(mesh.positions.end(), {1.0, 0.0, 0.0, 0.0, 1.0, 0.0});
  const auto shape = test::shape_of(mesh);
  for (const Index count : {2, 3, 100, 640}) {
    CHECK(sample_surface(*shape, count, 1).cols() == count);
  }
}

TEST_CASE("two sheets that touch are sampled apart") {
  // A closed flat bag: every place of the surface lies on another.
  const test::Mesh mesh =
      test::both(test::plane_grid(11, 11),
                 test::transformed(test::plane_grid(11, 11), 1.0, Eigen::Matrix3d::Identity(), {0.05, 0.05, 0.0}));
  const Points samples = sample_surface(*test::shape_of(mesh), 100, 1);
  CHECK(spread_of(samples).least > 0.07);
}

}  // namespace
}  // namespace pliant
