#include "pliant/geometry/patch.h"

#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

std::vector<Index> patch(const Shape& shape, const Points& positions, std::vector<Spot> spots, double radius) {
  return Patches(shape).around(positions, spots, radius);
}

/// Two sheets one above the other, close together.
test::Mesh two_sheets() {
  const test::Mesh sheet = test::plane_grid(21, 21);
  return test::both(sheet, test::transformed(sheet, 1.0, Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.01}));
}

TEST_CASE("a patch is what can be reached within its ball") {
  const auto shape = test::shape_of(two_sheets());
  const Eigen::Vector3d center = shape->points().col(220);
  const std::vector<Index> found = patch(*shape, shape->points(), {{220, center}}, 0.16);
  for (Index point = 0; point < 441; ++point) {
    const bool inside = (shape->points().col(point) - center).norm() <= 0.16;
    CHECK(inside == (std::find(found.begin(), found.end(), point) != found.end()));
  }
  CHECK(found.back() < 441);  // the other sheet lies within the ball, but nothing leads there
  CHECK(std::is_sorted(found.begin(), found.end()));
  CHECK(patch(*shape, shape->points(), {{220, center}}, 0.0) == std::vector<Index>{220});
}

TEST_CASE("a patch does not leave its ball and come back") {
  // A strip folded into a hairpin: its ends are near each other, the way between them is far.
  const test::Mesh strip = test::plane_grid(41, 3, 4.0, 0.2);
  const auto shape = test::shape_of(strip);
  Points folded = shape->points();
  for (auto p : folded.colwise()) p = p.x() < 2.0 ? Eigen::Vector3d(p) : Eigen::Vector3d(4.0 - p.x(), p.y(), 0.05);
  const std::vector<Index> found = patch(*shape, folded, {{0, folded.col(0)}}, 0.3);
  CHECK(found.size() > 6);
  for (const Index point : found) CHECK(point % 41 < 20);
}

TEST_CASE("the patch of several spots is what each of them finds") {
  const auto shape = test::shape_of(two_sheets());
  const Points& points = shape->points();
  const std::vector<Index> one = patch(*shape, points, {{30, points.col(30)}}, 0.1);
  const std::vector<Index> other = patch(*shape, points, {{470, points.col(470)}}, 0.1);
  std::vector<Index> both = one;
  both.insert(both.end(), other.begin(), other.end());
  CHECK(patch(*shape, points, {{470, points.col(470)}, {30, points.col(30)}}, 0.1) == both);
  CHECK(patch(*shape, points, {}, 0.1).empty());
}

TEST_CASE(
    "a spot's point belongs to the patch wherever its centre is; points that nothing joins are found by distance") {
  const auto surface = test::shape_of(test::plane_grid(5, 5));
  CHECK(patch(*surface, surface->points(), {{12, {9.0, 9.0, 9.0}}}, 0.5) == std::vector<Index>{12});
  test::Mesh mesh = two_sheets();
  mesh.triangles.resize(30);
  const auto scattered = test::shape_of(mesh);
  const std::vector<Index> found = patch(*scattered, scattered->points(), {{220, scattered->points().col(220)}}, 0.06);
  CHECK(found.size() == 10);  // five on either sheet
  CHECK(found.back() >= 441);
}

}  // namespace
}  // namespace pliant
