#include "pliant/geometry/canonical_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

Points ordered(const test::Mesh& mesh) {
  const auto shape = test::shape_of(mesh);
  return shape->points()(Eigen::all, canonical_order(*shape));
}

double largest_difference(const Points& a, const Points& b) {
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff();
}

/// Mirror-symmetric in z = 0, otherwise without symmetry.
test::Mesh with_mirror_plane() {
  test::Mesh mesh = test::sphere(2);
  for (Index v = 0; v < mesh.vertices(); ++v) {
    double* p = &mesh.positions[3 * v];
    p[0] = 2.0 * p[0] + 0.5 * p[1] * p[1];
    p[1] = 1.3 * p[1] + 0.3 * p[0] * p[2] * p[2];
  }
  return mesh;
}

const Eigen::Matrix3d quarter_turn = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();

TEST_CASE("the order is a permutation by distance from the centroid") {
  const auto shape = test::shape_of(test::potato(2));
  const std::vector<Index> order = canonical_order(*shape);
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Index> all(shape->points().cols());
  std::iota(all.begin(), all.end(), 0);
  CHECK(sorted == all);
  const Points centered = shape->points().colwise() - shape->points().rowwise().mean();
  for (std::size_t i = 1; i < order.size(); ++i) {
    CHECK(centered.col(order[i - 1]).norm() <= centered.col(order[i]).norm() + 1e-8);
  }
}

TEST_CASE("renumbering the points does not change the order, ties and symmetries included") {
  for (const test::Mesh& mesh : {test::potato(2), test::sphere(2), test::bumpy_plane(17, 2, 0.1), test::tube(12, 7),
                                 test::torus(16, 8), test::box(2, 1, 1, 0.25), with_mirror_plane()}) {
    CHECK(largest_difference(ordered(mesh), ordered(test::renumbered(mesh, 3))) == 0.0);
  }
}

TEST_CASE("the order moves with the scene") {
  const Eigen::Vector3d away(30, -70, 110);
  const Eigen::Matrix3d any = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const test::Mesh& mesh : {test::potato(2), with_mirror_plane()}) {
    const Points rest = ordered(mesh);
    for (const Eigen::Matrix3d& turn : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), quarter_turn, any}) {
      const Points moved = ordered(test::transformed(mesh, 0.01, turn, away));
      const Points expected = ((0.01 * turn) * rest).colwise() + away;
      CHECK(largest_difference(moved, expected) < 1e-13 * away.norm());
    }
  }
}

TEST_CASE("symmetric shapes keep their order when moved and scaled") {
  const Eigen::Vector3d away(3, -7, 11);
  for (const test::Mesh& mesh : {test::sphere(2), test::torus(16, 8), test::plane_grid(9, 9)}) {
    const Points moved = ordered(test::transformed(mesh, 100.0, Eigen::Matrix3d::Identity(), away));
    const Points expected = (100.0 * ordered(mesh)).colwise() + away;
    CHECK(largest_difference(moved, expected) < 1e-12 * 100.0);
  }
}

TEST_CASE("rounding noise is dropped, differences are not") {
  for (const double value : {1.0 / 3.0, 0.1, 2.0, 7e-20, 3e25}) {
    CHECK(without_rounding_noise(value) == doctest::Approx(value).epsilon(1e-9));
    CHECK(without_rounding_noise(std::nextafter(value, 0.0)) == without_rounding_noise(value));
    CHECK(without_rounding_noise(value * (1 + 1e-8)) > without_rounding_noise(value));
  }
  CHECK(without_rounding_noise(0.0) == 0.0);
}

}  // namespace
}  // namespace pliant
