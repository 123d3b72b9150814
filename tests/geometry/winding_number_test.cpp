#include "pliant/geometry/winding_number.h"

#include <doctest/doctest.h>

#include "support/random.h"
#include "support/shapes.h"

using namespace pliant;

TEST_CASE("the winding number is 1 inside a closed surface and 0 outside") {
  const auto sphere = test::shape_of(test::sphere(3));
  const WindingNumber winding(sphere->points(), sphere->triangles());
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d place = 2.0 * random.vector(3);
    if (std::abs(place.norm() - 1.0) < 0.05) continue;
    CHECK(winding.at(place) == doctest::Approx(place.norm() < 1.0 ? 1.0 : 0.0).epsilon(0.05));
  }
}

TEST_CASE("the winding number of an open tube tells inside from outside away from its ends") {
  const auto tube = test::shape_of(test::tube(24, 20, 0.5, 4.0));
  const WindingNumber winding(tube->points(), tube->triangles());
  CHECK(std::abs(winding.at({0.1, 0.0, 2.0})) > 0.8);
  CHECK(std::abs(winding.at({0.8, 0.0, 2.0})) < 0.2);
}

TEST_CASE("without triangles nothing is inside") {
  const Points none(3, 0);
  const Triangles no_triangles(3, 0);
  CHECK(WindingNumber(none, no_triangles).at({0, 0, 0}) == 0.0);
}
