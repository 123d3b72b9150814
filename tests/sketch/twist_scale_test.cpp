// Must show 2 of the issue: twist and scale about the joints.
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "sketch/sketch_support.h"

namespace pliant {
namespace {

using test::front_pixel;

constexpr double pi = std::numbers::pi;
constexpr int around = 40, along = 120;
constexpr double radius = 0.06;

const test::Mesh& rod() {
  static const test::Mesh mesh = test::cylinder(around, along, radius);
  return mesh;
}

Stroke reference() { return test::straight(front_pixel(0.0, 0.1), front_pixel(0.0, 0.9)); }

/// Twice the area of a ring as a polygon in space.
double area(const Points& positions, int ring) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < around; ++i) {
    const Eigen::Vector3d a = positions.col(ring * around + i);
    const Eigen::Vector3d b = positions.col(ring * around + (i + 1) % around);
    sum += a.cross(b);
  }
  return sum.norm();
}

std::unique_ptr<Sketch> plain(const Stroke& stroke, const CameraOptions& camera) {
  SketchOptions options;
  options.smooth = false;
  return test::sketch_on(rod(), stroke, options, camera);
}

TEST_CASE("twist turns linearly in s, right-handed, and keeps the sections") {
  CameraOptions near = test::front_view();
  near.orthographic_height.reset();
  near.eye.y() = -2.0;
  near.fov_y = 2.0 * std::atan(1.0 / 2.0) * 180.0 / pi;
  for (const CameraOptions& camera : {test::front_view(), near}) {
    const auto sketch = plain(reference(), camera);
    const double angle = 2.5 * pi;
    REQUIRE(sketch->twist(angle).ok());
    const Points rest = test::positions_of(rod()), twisted = sketch->positions();
    const std::vector<double> s = sketch->parameters();
    const std::vector<Index> labels = sketch->labels();
    for (Index v = 0; v < around * along; ++v) {
      if (labels[v] != 1) continue;
      const Eigen::AngleAxisd turn(s[v] * angle, Eigen::Vector3d::UnitZ());
      CHECK((turn * rest.col(v) - twisted.col(v)).norm() < 1e-6);
      CHECK(s[v] == doctest::Approx((rest(2, v) - 0.1) / 0.8).epsilon(0.1));
    }
    const State state = sketch->save();
    for (Index v = 0; v < around * along; ++v) {
      CHECK(state.find("angles")->data[v] == doctest::Approx(labels[v] == 0 ? 0.0 : s[v] * angle).epsilon(1e-6));
    }
    for (int ring = 0; ring < along; ++ring) {
      CHECK(area(twisted, ring) == doctest::Approx(area(rest, ring)).epsilon(0.001));
    }
  }
}

TEST_CASE("the twist's speed follows its profile") {
  const auto sketch = plain(reference(), test::front_view());
  const std::vector<Profile::Point> points{{0.0, 0.0}, {0.5, 1.0}, {1.0, 1.0}};
  sketch->set_twist_speed(*Profile::create(points, "speed"));
  REQUIRE(sketch->twist(1.0).ok());
  const std::vector<double> s = sketch->parameters();
  const State state = sketch->save();
  const std::vector<Index> labels = sketch->labels();
  for (Index v = 0; v < around * along; ++v) {
    if (labels[v] != 1) continue;
    CHECK(state.find("twists")->data[v] == doctest::Approx(std::min(1.0, 2.0 * s[v])));
  }
}

TEST_CASE("scale changes the radius by F(s)") {
  const auto sketch = plain(reference(), test::front_view());
  const std::vector<Profile::Point> points{{0.0, 1.0}, {0.3, 2.0}, {0.7, 0.5}, {1.0, 1.0}};
  const Profile factor = *Profile::create(points, "scale");
  REQUIRE(sketch->set_scale(factor).ok());
  const Points scaled = sketch->positions();
  for (int ring = 0; ring < along; ++ring) {
    const double z = static_cast<double>(ring) / (along - 1);
    if (z < 0.13 || z > 0.87) continue;
    const double ratio = std::sqrt(area(scaled, ring) / area(test::positions_of(rod()), ring));
    CHECK(ratio == doctest::Approx(factor((z - 0.1) / 0.8)).epsilon(0.01));
  }
}

TEST_CASE("a rigid part keeps its size when the region is scaled") {
  const auto sketch = test::sketch_on(rod(), reference());
  REQUIRE(sketch->set_scale(Profile::constant(1.8)).ok());
  const std::vector<Index> labels = sketch->labels();
  const Points scaled = sketch->positions(), rest = test::positions_of(rod());
  for (Index v = 0; v < rod().vertices(); ++v) {
    if (labels[v] != 1) CHECK((scaled.col(v) - rest.col(v)).norm() < 1e-9);
  }
}

TEST_CASE("without two hits at every node twist and scale are refused and nothing changes") {
  const auto beside = plain(test::straight(front_pixel(0.08, 0.1), front_pixel(0.0, 0.9)), test::front_view());
  const Status twisted = beside->twist(1.0);
  CHECK(twisted.code() == ErrorCode::invalid_option);
  CHECK(twisted.message().find("reference meets the shape nowhere at pixel (540") == 0);
  CHECK(beside->positions() == test::positions_of(rod()));
  CHECK(beside->bend(reference()).ok());

  const test::Mesh sheet = test::transformed(test::plane_grid(30, 30), 1.0,
                                             Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix());
  const auto flat = test::sketch_on(sheet, test::straight(front_pixel(0.5, 0.2), front_pixel(0.5, 0.8)));
  CHECK(flat->twist(1.0).message().find("only once") != std::string::npos);
  CHECK_FALSE(flat->set_scale(Profile::constant(2.0)).ok());
  // Two sheets back to back at one place are one hit.
  test::Mesh copies = test::both(sheet, sheet);
  const auto doubled = test::sketch_on(copies, test::straight(front_pixel(0.5, 0.2), front_pixel(0.5, 0.8)));
  CHECK_FALSE(doubled->twist(1.0).ok());
}

TEST_CASE("bad angles and factors are named") {
  const auto sketch = plain(reference(), test::front_view());
  CHECK(sketch->twist(std::nan("")).message() == "twist is not finite; expected an angle");
  CHECK(sketch->set_scale(Profile::constant(0.0)).message() == "scale is 0 at s = 0; expected factors above 0");
}

}  // namespace
}  // namespace pliant
