#include "pliant/geometry/cotangent.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace pliant;

namespace {

Eigen::Vector3d corners(const Eigen::Matrix3d& triangle) {
  Triangles one(3, 1);
  one << 0, 1, 2;
  return half_cotangents(triangle, one).col(0);
}

Eigen::Matrix3d triangle(double x, double y) {
  Eigen::Matrix3d points;
  points << 0, 1, x, 0, 0, y, 0, 0, 0;
  return points;
}

}  // namespace

TEST_CASE("half cotangents: equilateral, right-angled and obtuse corners") {
  CHECK((corners(triangle(0.5, std::sqrt(0.75))).array() - 0.5 / std::sqrt(3.0)).abs().maxCoeff() < 1e-15);
  const Eigen::Vector3d right = corners(triangle(0.0, 1.0));
  CHECK(right.isApprox(Eigen::Vector3d(0.0, 0.5, 0.5), 1e-15));
  CHECK(corners(triangle(0.5, 0.1))[2] < 0.0);
}

TEST_CASE("half cotangents: without a height they are finite, and the Dirichlet energy is not negative") {
  for (double height : {1e-3, 1e-9, 0.0}) {
    for (double x : {0.5, 0.01, 3.0}) {
      const Eigen::Matrix3d points = triangle(x, height);
      const Eigen::Vector3d w = corners(points);
      CHECK(w.allFinite());
      // sum w_c (u_a - u_b)^2 for a few values at the corners.
      for (const Eigen::Vector3d& u : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, x)}) {
        double energy = 0.0;
        for (int c = 0; c < 3; ++c) energy += w[c] * std::pow(u[(c + 1) % 3] - u[(c + 2) % 3], 2);
        CHECK(energy > -1e-9 * w.cwiseAbs().maxCoeff());
      }
    }
  }
}
