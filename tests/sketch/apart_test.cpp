// Cuts partition the shape: no edge joins the static part and a rigid one, whatever the genus and
// however one draws. Kho and Garland, section 4.2.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/sketch/region.h"
#include "sketch/sketch_support.h"
#include "support/random.h"

namespace pliant {
namespace {

using test::front_pixel;

/// A ring seen from the front: around (0, 0.5), tube from 0.35 to 0.65 of it.
test::Mesh ring() {
  const Eigen::Matrix3d standing = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).matrix();
  return test::transformed(test::torus(96, 32), 0.5, standing, {0.0, 0.0, 0.5});
}

/// A slab seen from the front, 1.25 wide and 0.75 high, with two holes: genus 2.
test::Mesh slab() {
  const test::Mesh cells = test::cells(
      30, 4, 18, [](int x, int, int z) { return !(z >= 6 && z < 12 && ((x >= 6 && x < 12) || (x >= 18 && x < 24))); });
  return test::transformed(cells, 1.0 / 24, Eigen::Matrix3d::Identity(), {-15.0 / 24, -2.0 / 24, 0.1});
}

/// A base with a prong, and a ring on it beside.
test::Mesh ring_and_prong() {
  const test::Mesh cells = test::cells(30, 4, 24, [](int x, int, int z) {
    const bool prong = x >= 22 && x < 26;
    const bool arch = x >= 2 && x < 16 && z < 20 && !(x >= 5 && x < 13 && z < 16);
    return z < 4 || prong || arch;
  });
  return test::transformed(cells, 1.0 / 24, Eigen::Matrix3d::Identity(), {-15.0 / 24, -2.0 / 24, 0.0});
}

test::Mesh ball() { return test::transformed(test::potato(4), 0.4, Eigen::Matrix3d::Identity(), {0, 0, 0.5}); }

/// How many corners of triangles have another corner of another part, neither of the region.
int torn(const test::Mesh& mesh, const std::vector<Index>& labels) {
  int count = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Index a = labels[mesh.triangles[i]], b = labels[mesh.triangles[i % 3 == 2 ? i - 2 : i + 1]];
    count += a != b && a != kRegionLabel && b != kRegionLabel;
  }
  return count;
}

TEST_CASE("a stroke over one tube of a ring takes what lies between its planes on the other, too") {
  const test::Mesh mesh = ring();
  const auto sketch = test::sketch_on(mesh, test::straight(front_pixel(-0.15, 1.0), front_pixel(0.15, 1.0)));
  const std::vector<Index> labels = sketch->labels();
  CHECK(torn(mesh, labels) == 0);
  const Points rest = test::positions_of(mesh);
  for (Index v = 0; v < mesh.vertices(); ++v) {
    const double x = rest(0, v);
    if (x < -0.18) CHECK(labels[v] == kStaticLabel);
    if (std::abs(x) < 0.12) CHECK(labels[v] == kRegionLabel);
    if (x > 0.18) CHECK(labels[v] == kFirstRigidLabel);
  }
  // Half a radian downwards.
  Stroke target = test::straight(front_pixel(-0.15, 1.0), front_pixel(0.15, 1.0));
  for (auto pixel : target.colwise()) {
    const double along = (pixel.x() - target(0, 0)) / 150.0;
    pixel.y() += 37.5 * along * along;
  }
  REQUIRE(sketch->bend(target).ok());
  const Points bent = sketch->positions();
  double stretch = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto a = static_cast<Index>(mesh.triangles[i]);
    const auto b = static_cast<Index>(mesh.triangles[i % 3 == 2 ? i - 2 : i + 1]);
    stretch = std::max(stretch, (bent.col(a) - bent.col(b)).norm() / (rest.col(a) - rest.col(b)).norm());
  }
  CHECK(stretch < 2.0);
}

TEST_CASE("a stroke along a bar takes what lies between its planes on the other bars of genus 2") {
  const test::Mesh mesh = slab();
  const auto sketch = test::sketch_on(mesh, test::straight(front_pixel(0.0, 0.38), front_pixel(0.0, 0.58)));
  const std::vector<Index> labels = sketch->labels();
  CHECK(torn(mesh, labels) == 0);
  const Points rest = test::positions_of(mesh);
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (rest(2, v) < 0.34) CHECK(labels[v] == kStaticLabel);
    if (rest(2, v) > 0.42 && rest(2, v) < 0.54) CHECK(labels[v] == kRegionLabel);
    if (rest(2, v) > 0.62) CHECK(labels[v] == kFirstRigidLabel);
  }
}

TEST_CASE("no stroke, and no partition, tears a shape") {
  test::Random random(7);
  int chosen = 0, partitioned = 0;
  for (const test::Mesh& mesh : {ring(), slab(), ring_and_prong(), ball(), test::cylinder(24, 60, 0.1)}) {
    const auto shape = test::shape_of(mesh);
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector2d start = front_pixel(0.7 * random.number(), 0.5 + 0.6 * random.number());
      const double length = 0.15 + 0.35 * (1.0 + random.number()), bend = 4.0 * random.number();
      Stroke reference = test::curved(
          {0, 0}, length, [&](double) { return bend; }, 60);
      const Eigen::Rotation2Dd turn(std::numbers::pi * random.number());
      for (auto pixel : reference.colwise()) pixel = start + turn * pixel;
      SketchOptions options;
      if (i % 3 == 0) {
        const Index at = 10 + i % 40;
        const Eigen::Vector2d along = reference.col(at + 1) - reference.col(at);
        const Eigen::Vector2d across = 100.0 * Eigen::Vector2d(-along.y(), along.x()).normalized();
        options.partitions = {test::straight(reference.col(at) - across, reference.col(at) + across)};
      }
      const auto sketch = Sketch::create(shape, *Camera::create(test::front_view()), reference, options);
      if (!sketch.ok()) continue;
      ++chosen;
      partitioned += i % 3 == 0;
      CHECK_MESSAGE(torn(mesh, (*sketch)->labels()) == 0, "stroke " << i << " over " << mesh.vertices());
    }
  }
  CHECK(chosen > 150);
  CHECK(partitioned > 30);
}

TEST_CASE("labels that tear a shape are refused") {
  const test::Mesh mesh = test::cylinder(8, 20, 0.1);
  SketchOptions options;
  for (Index v = 0; v < mesh.vertices(); ++v) options.labels.push_back(mesh.vertex(v).z() < 0.5 ? 0 : 2);
  options.labels[80] = 1;  // the centre of the lower lid
  const auto sketch = Sketch::create(test::shape_of(mesh), *Camera::create(test::front_view()),
                                     test::straight(front_pixel(0.0, 0.2), front_pixel(0.0, 0.8)), options);
  CHECK(sketch.status().code() == ErrorCode::invalid_option);
  CHECK(sketch.status().message() ==
        "labels[81] is 2 beside labels[72], 0; expected vertices of the region (1) between");
}

}  // namespace
}  // namespace pliant
