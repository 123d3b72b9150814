#include "pliant/sketch/camera.h"

#include <cmath>

#include <doctest/doctest.h>

#include "sketch/sketch_support.h"
#include "support/random.h"

namespace pliant {
namespace {

TEST_CASE("pixels and places in view are inverse, and the middle looks at the target") {
  CameraOptions options;
  options.eye = {3, 2, 5};
  options.target = {0.5, 0.2, -0.3};
  options.fov_y = 40;
  options.width = 640;
  options.height = 480;
  test::Random random(1);
  for (const bool orthographic : {false, true}) {
    if (orthographic) options.orthographic_height = 2.5;
    const Camera camera = *Camera::create(options);
    CHECK((camera.pixel(camera.to_view(options.target)) - Eigen::Vector2d(320, 240)).norm() < 1e-9);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d p(random.number(), random.number(), random.number());
      const Eigen::Vector3d view = camera.to_view(p);
      CHECK((camera.to_world(view) - p).norm() < 1e-12);
      CHECK((camera.at_depth(camera.pixel(view), view.z()) - view.head<2>()).norm() < 1e-12);
    }
    // Up is up, right is right.
    CHECK(camera.pixel(camera.to_view(options.target + Eigen::Vector3d(0, 0.1, 0))).y() < 240);
    CHECK(camera.pixel(camera.to_view(options.target + Eigen::Vector3d(0.1, 0, -0.06))).x() > 320);
  }
}

TEST_CASE("a mirrored camera sees the mirrored scene") {
  const Camera camera = *Camera::create(test::front_view());
  const Plane plane{{0.3, 0.1, 0.2}, {1, 2, -0.5}};
  const Camera mirrored = camera.mirrored(plane);
  const Eigen::Vector3d n = plane.normal.normalized();
  test::Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p(random.number(), random.number(), random.number());
    const Eigen::Vector3d q = p - 2.0 * n.dot(p - plane.point) * n;
    CHECK((mirrored.to_view(q) - camera.to_view(p)).norm() < 1e-12);
    CHECK((mirrored.to_world(mirrored.to_view(p)) - p).norm() < 1e-12);
  }
}

TEST_CASE("bad cameras are named") {
  const auto message = [](auto change) {
    CameraOptions options = test::front_view();
    change(options);
    return Camera::create(options).status().message();
  };
  CHECK(message([](auto& o) { o.width = 0; }) == "camera.width is 0; expected pixels from 1 to 1000000");
  CHECK(message([](auto& o) { o.eye = o.target; }).find("camera.target equals") == 0);
  CHECK(message([](auto& o) { o.up = {0, 1, 0}; }).find("camera.up is zero or along") == 0);
  CHECK(message([](auto& o) { o.eye.x() = std::nan(""); }).find("camera.eye is NaN") == 0);
  CHECK(message([](auto& o) { o.orthographic_height = -1; }).find("orthographicHeight") != std::string::npos);
  CHECK(message([](auto& o) {
          o.orthographic_height.reset();
          o.fov_y = 180;
        }) == "camera.fovY is 180; expected degrees above 0 and below 180");
}

}  // namespace
}  // namespace pliant
