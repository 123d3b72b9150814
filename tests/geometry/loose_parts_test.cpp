#include "pliant/geometry/loose_parts.h"

#include <cmath>

#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

const Eigen::Matrix3d kUpright = Eigen::Matrix3d::Identity();

/// A ball with two eyes that touch nothing, the left one finer.
test::Mesh head() {
  const test::Mesh ball = test::sphere(4);
  const test::Mesh left = test::transformed(test::sphere(2), 0.1, kUpright, {0.4, 0.3, 1.0});
  const test::Mesh right = test::transformed(test::sphere(1), 0.1, kUpright, {-0.4, 0.3, 1.0});
  return test::both(test::both(right, ball), left);
}

TEST_CASE("loose parts are the small ones, and lie beside what is nearest to them") {
  const auto shape = test::shape_of(head());
  const std::vector<LoosePart> parts = loose_parts(*shape);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].points.size() == 162);  // most points first
  CHECK(parts[1].points.size() == 42);
  CHECK(parts[1].points.front() == 0);
  for (const LoosePart& part : parts) {
    CHECK(std::is_sorted(part.beside.begin(), part.beside.end()));
    const Eigen::Vector3d center = shape->points()(Eigen::all, part.points).rowwise().mean();
    double nearest = 1e9;
    for (const Index point : part.beside) {
      CHECK(point >= 42);
      CHECK(point < 42 + 2562);  // of the ball
      const double distance = (shape->points().col(point) - center).norm();
      CHECK(distance < 0.6);
      nearest = std::min(nearest, distance);
    }
    double least = 1e9;
    for (Index point = 42; point < 42 + 2562; ++point) {
      least = std::min(least, (shape->points().col(point) - center).norm());
    }
    CHECK(nearest == doctest::Approx(least));
    CHECK(part.beside.size() > 19);  // two rings around a point
  }
}

TEST_CASE("large parts, points and the plane have no loose parts") {
  const test::Mesh ball = test::sphere(2);
  CHECK(loose_parts(*test::shape_of(ball)).empty());
  CHECK(loose_parts(*test::shape_of(test::both(ball, test::transformed(ball, 0.05, kUpright, {3, 0, 0})))).empty());
  CHECK(loose_parts(*test::shape_of(test::both(test::sphere(4), test::transformed(ball, 0.6, kUpright, {2, 0, 0}))))
            .empty());
  CHECK(loose_parts(*test::shape_of({head().positions, {}})).empty());
}

TEST_CASE("a heap of pieces has no loose parts, and coarse ones far away are found") {
  test::Mesh heap = test::sphere(4);
  for (std::size_t i = 0; i < kMostLooseParts; ++i) {
    heap =
        test::both(heap, test::transformed(test::sphere(0), 0.02, kUpright, {2.0, 0.1 * static_cast<double>(i), 0.0}));
  }
  CHECK(loose_parts(*test::shape_of(heap)).size() == kMostLooseParts);
  heap = test::both(heap, test::transformed(test::sphere(0), 0.02, kUpright, {-2.0, 0.0, 0.0}));
  CHECK(loose_parts(*test::shape_of(heap)).empty());
}

}  // namespace
}  // namespace pliant
