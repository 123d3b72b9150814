// The camera a stroke was drawn through: pixels to rays and back, without a screen.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "pliant/core/status.h"

namespace pliant {

/// A plane in space, by a point of it and its normal (any length).
struct Plane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

/// CAMERA of docs/edit-script.md. Pixels are square, their origin the top left corner of the picture, y
/// down.
struct CameraOptions {
  Eigen::Vector3d eye = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double fov_y = 45.0;                        ///< degrees, used unless orthographic
  std::optional<double> orthographic_height;  ///< height of the picture in the scene's unit
  double width = 0.0;                         ///< of the picture, pixels
  double height = 0.0;
};

/// View coordinates are (x to the right, y up, depth away from the eye), in the scene's unit, from
/// the eye: planes of one depth are parallel to the image.
class Camera {
 public:
  /// Errors: invalid_option (not finite, eye at target, up along the view, sizes or angle out of
  /// range).
  static Result<Camera> create(const CameraOptions& options);

  /// The camera's reflection in a plane: it sees the reflected scene in the same pixels. Its view
  /// coordinates are left-handed where this one's are right-handed.
  Camera mirrored(const Plane& plane) const;

  Eigen::Vector3d to_view(const Eigen::Vector3d& p) const { return axes_ * (p - eye_); }
  Eigen::Vector3d to_world(const Eigen::Vector3d& v) const { return eye_ + axes_.transpose() * v; }
  /// Rows: right, up, forward; orthonormal.
  const Eigen::Matrix3d& axes() const { return axes_; }

  /// Width of a pixel at a depth, in the scene's unit.
  double pixel_size(double depth) const { return perspective_ ? depth * pixel_ : pixel_; }
  /// The place (x, y) in view coordinates that a pixel shows at a depth.
  Eigen::Vector2d at_depth(const Eigen::Vector2d& pixel, double depth) const;
  /// The pixel in which a point in view coordinates shows. In perspective its depth must be above
  /// 0.
  Eigen::Vector2d pixel(const Eigen::Vector3d& view) const;
  /// Whether a depth is in front of the eye; always, without perspective.
  bool sees(double depth) const { return !perspective_ || depth > 0.0; }

 private:
  Camera() = default;

  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();  ///< pixel the view's axis goes through
  bool perspective_ = true;
  double pixel_ = 1.0;  ///< width of a pixel, at depth 1 in perspective
};

}  // namespace pliant
