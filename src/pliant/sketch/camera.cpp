#include "pliant/sketch/camera.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "pliant/core/message.h"

namespace pliant {
namespace {

constexpr double kMaxPixels = 1e6;
constexpr double kMaxSize = 1e30;  // as Shape::max_coordinate

Status bad(const char* field, double value, const char* expected) {
  return {ErrorCode::invalid_option, message({"camera.", field, " is ", value, "; expected ", expected})};
}

Status check_vector(const char* field, const Eigen::Vector3d& v) {
  for (const double x : v) {
    if (!(std::abs(x) <= kMaxSize)) return bad(field, x, "three finite numbers up to 1e30");
  }
  return {};
}

Status check(const CameraOptions& o) {
  if (Status status = check_vector("eye", o.eye); !status.ok()) return status;
  if (Status status = check_vector("target", o.target); !status.ok()) return status;
  if (Status status = check_vector("up", o.up); !status.ok()) return status;
  if (!(o.width >= 1.0 && o.width <= kMaxPixels)) {
    return bad("width", o.width, "pixels from 1 to 1000000");
  }
  if (!(o.height >= 1.0 && o.height <= kMaxPixels)) {
    return bad("height", o.height, "pixels from 1 to 1000000");
  }
  if (o.orthographic_height) {
    const double h = *o.orthographic_height;
    if (!(h > 0.0 && h <= kMaxSize)) return bad("orthographicHeight", h, "a finite length above 0");
  } else if (!(o.fov_y > 0.0 && o.fov_y < 180.0)) {
    return bad("fovY", o.fov_y, "degrees above 0 and below 180");
  }
  return {};
}

}  // namespace

Result<Camera> Camera::create(const CameraOptions& options) {
  if (Status status = check(options); !status.ok()) return status;
  const Eigen::Vector3d forward = (options.target - options.eye).stableNormalized();
  if (!(forward.norm() > 0.5)) {
    return Status(ErrorCode::invalid_option, "camera.target equals camera.eye; expected two different points");
  }
  const Eigen::Vector3d right = forward.cross(options.up.stableNormalized());
  if (!(right.norm() > 1e-9)) {
    return Status(ErrorCode::invalid_option, "camera.up is zero or along the view; expected a direction across it");
  }
  Camera camera;
  camera.eye_ = options.eye;
  camera.axes_.row(0) = right.normalized();
  camera.axes_.row(1) = camera.axes_.row(0).cross(forward);
  camera.axes_.row(2) = forward;
  camera.center_ = 0.5 * Eigen::Vector2d(options.width, options.height);
  camera.perspective_ = !options.orthographic_height;
  const double height =
      camera.perspective_ ? 2.0 * std::tan(options.fov_y * std::numbers::pi / 360.0) : *options.orthographic_height;
  camera.pixel_ = height / options.height;
  return camera;
}

Camera Camera::mirrored(const Plane& plane) const {
  const Eigen::Vector3d n = plane.normal.normalized();
  Camera camera = *this;
  camera.eye_ -= 2.0 * n.dot(eye_ - plane.point) * n;
  camera.axes_ -= 2.0 * (axes_ * n) * n.transpose();
  return camera;
}

Eigen::Vector2d Camera::at_depth(const Eigen::Vector2d& pixel, double depth) const {
  return pixel_size(depth) * Eigen::Vector2d(pixel.x() - center_.x(), center_.y() - pixel.y());
}

Eigen::Vector2d Camera::pixel(const Eigen::Vector3d& view) const {
  const double size = pixel_size(view.z());
  return {center_.x() + view.x() / size, center_.y() - view.y() / size};
}

}  // namespace pliant
