#include "pliant/solve/handle.h"

#include <doctest/doctest.h>

#include "pliant/core/types.h"

using namespace pliant;

TEST_CASE("a motion scales about its center, turns about a point, then translates") {
  Motion motion;
  motion.scale = 2.0;
  motion.center = {1, 0, 0};
  motion.axis = {0, 0, 3};
  motion.angle = 1.5707963267948966;
  motion.about = {0, 1, 0};
  motion.translation = {0, 0, 5};
  // (2, 1, 1) -> (3, 2, 2) -> (-1, 4, 2) -> (-1, 4, 7)
  CHECK((motion.apply({2, 1, 1}) - Eigen::Vector3d(-1, 4, 7)).norm() < 1e-14);
}

TEST_CASE("a motion moves columns in place as it moves copies of them") {
  // clang 14 compiled this loop wrongly for WASM with its SLP vectoriser on (CMakeLists.txt).
  Motion motion;
  motion.axis = {1, 2, -1};
  motion.angle = 1.5;
  motion.about = {3, 0, 1};
  motion.translation = {0.5, -2, 1};
  Points points(3, 4);
  for (Index i = 0; i < points.cols(); ++i) points.col(i) << 0.1 + i, 0.2, 0.3;
  const Points rest = points;
  for (auto column : points.colwise()) column = motion.apply(column);
  const Eigen::Affine3d map = motion.map();
  for (Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d moved = map * rest.col(i);
    CHECK((points.col(i) - moved).norm() < 1e-14);
  }
}
