#include "pliant/geometry/triangle_crossing.h"

#include <random>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

namespace pliant {
namespace {

Eigen::Matrix3d triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Eigen::Matrix3d corners;
  corners << a, b, c;
  return corners;
}

const Eigen::Matrix3d flat = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

bool cross_both_ways(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const bool cross = triangles_cross(a, b, 1e-10);
  CHECK(triangles_cross(b, a, 1e-10) == cross);
  return cross;
}

double volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// A side of `a` runs through `b`: its ends lie on both sides of the plane, and the line through
/// them leaves all three sides of `b` on one hand.
bool a_side_pierces(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d p = a.col(i);
    const Eigen::Vector3d q = a.col((i + 1) % 3);
    const double above = volume(b.col(0), b.col(1), b.col(2), p);
    const double below = volume(b.col(0), b.col(1), b.col(2), q);
    const double u = volume(p, q, b.col(0), b.col(1));
    const double v = volume(p, q, b.col(1), b.col(2));
    const double w = volume(p, q, b.col(2), b.col(0));
    if (above * below < 0 && u * v > 0 && v * w > 0) {
      return true;
    }
  }
  return false;
}

TEST_CASE("random triangles cross exactly when a side of one pierces the other") {
  std::mt19937 random(1);
  const auto corner = [&] {
    const auto next = [&] { return random() / 4294967296.0; };
    const double x = next();
    const double y = next();
    return Eigen::Vector3d(x, y, next());
  };
  int crossing = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Eigen::Matrix3d a = triangle(corner(), corner(), corner());
    const Eigen::Matrix3d b = triangle(corner(), corner(), corner());
    const bool expected = a_side_pierces(a, b) || a_side_pierces(b, a);
    REQUIRE(cross_both_ways(a, b) == expected);
    crossing += expected;
  }
  CHECK(crossing > 1000);
  CHECK(crossing < 19000);
}

TEST_CASE("contacts do not count") {
  // Another triangle standing on it, on a corner and on a side; one touching it corner to corner.
  CHECK(!cross_both_ways(flat, triangle({1, 1, 0}, {1, 1, 2}, {2, 1, 2})));
  CHECK(!cross_both_ways(flat, triangle({1, 1, 0}, {2, 1, 0}, {1, 1, 2})));
  CHECK(!cross_both_ways(flat, triangle({4, 0, 0}, {5, 0, 1}, {5, 0, -1})));
  // The same, pushed in by rounding and pushed in for good.
  CHECK(!cross_both_ways(flat, triangle({1, 1, -1e-12}, {1, 1, 2}, {2, 1, 2})));
  CHECK(cross_both_ways(flat, triangle({1, 1, -1e-6}, {1, 1, 2}, {2, 1, 2})));
}

TEST_CASE("a corner in the other's plane does not hide a crossing") {
  CHECK(cross_both_ways(flat, triangle({1, 1, 0}, {2, 1, -1}, {2, 1, 1})));
}

TEST_CASE("in one plane triangles cross where they overlap") {
  CHECK(cross_both_ways(flat, triangle({1, 1, 0}, {5, 1, 0}, {1, 5, 0})));
  CHECK(cross_both_ways(flat, triangle({1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0})));
  CHECK(cross_both_ways(flat, flat));
  CHECK(!cross_both_ways(flat, triangle({4, 0, 0}, {4, 4, 0}, {0, 4, 0})));
  CHECK(!cross_both_ways(flat, triangle({5, 0, 0}, {9, 0, 0}, {5, 4, 0})));
  CHECK(!cross_both_ways(flat, triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1})));
}

TEST_CASE("triangles without area cross nothing") {
  CHECK(!cross_both_ways(flat, triangle({1, 1, -1}, {1, 1, 1}, {1, 1, 3})));
  CHECK(!cross_both_ways(flat, triangle({1, 1, 0}, {1, 1, 0}, {1, 1, 0})));
}

}  // namespace
}  // namespace pliant
