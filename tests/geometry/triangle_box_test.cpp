#include "pliant/geometry/triangle_box.h"

#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

namespace {

/// Whether any of many points of the triangle lies in the box.
bool sampled(const Eigen::Matrix3d& corners, const CenteredBox& box, int steps) {
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const Eigen::Vector3d p = corners * Eigen::Vector3d(i, j, steps - i - j) / steps;
      if (((p - box.center).cwiseAbs().array() <= box.half.array()).all()) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("a triangle meets a box exactly where points of it lie inside") {
  test::Random random(11);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Matrix3d corners = random.vector(9).reshaped(3, 3);
    const CenteredBox box{0.5 * random.vector(3), Eigen::Vector3d::Constant(0.15)};
    const bool meets = triangle_meets_box(corners, box);
    met += meets;
    if (sampled(corners, box, 60)) CHECK(meets);
    // A little smaller, the box is met only where fine samples find it.
    if (triangle_meets_box(corners, {box.center, 0.9 * box.half})) CHECK(sampled(corners, box, 200));
  }
  CHECK(met > 200);
  CHECK(met < 1800);
}

TEST_CASE("segments, points and faces of boxes are met, too; touching counts") {
  Eigen::Matrix3d segment;
  segment << -1, 1, 1, 0.2, 0.2, 0.2, 0, 0, 0;
  CHECK(triangle_meets_box(segment, {{0, 0, 0}, {0.5, 0.5, 0.5}}));
  CHECK_FALSE(triangle_meets_box(segment, {{0, 0.8, 0}, {0.5, 0.5, 0.5}}));
  CHECK(triangle_meets_box(segment, {{0, 0, 0}, {0.0, 0.5, 0.5}}));
  CHECK_FALSE(triangle_meets_box(segment, {{0, 0, 0.1}, {0.5, 0.5, 0.0}}));
  const Eigen::Matrix3d point = Eigen::Vector3d(0.5, 0.5, 0.5).replicate<1, 3>();
  CHECK(triangle_meets_box(point, {{0, 0, 0}, {0.5, 0.5, 0.5}}));
}
