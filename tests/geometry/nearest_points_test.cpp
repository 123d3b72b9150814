#include "pliant/geometry/nearest_points.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

TEST_CASE("the nearest points are those a plain search finds") {
  test::Random random(5);
  const Points points = random.vector(600).reshaped(3, 200);
  const NearestPoints nearest(points);
  std::vector<Index> found;
  std::vector<double> squared;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d place = random.vector(3);
    nearest.find(place, 7, found, squared);
    std::vector<double> all;
    for (const auto& p : points.colwise()) all.push_back((p - place).squaredNorm());
    std::sort(all.begin(), all.end());
    REQUIRE(found.size() == 7);
    for (std::size_t k = 0; k < 7; ++k) {
      CHECK(squared[k] == doctest::Approx(all[k]));
      CHECK((points.col(found[k]) - place).squaredNorm() == doctest::Approx(all[k]));
    }
  }
  nearest.find({0, 0, 0}, 500, found, squared);
  CHECK(found.size() == 200);
}
