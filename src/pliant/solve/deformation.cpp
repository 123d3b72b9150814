#include "pliant/solve/deformation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace pliant {

namespace {

/// Short against the shape, long against what is lost far from the origin.
double difference_step(double diagonal, const Points& points) {
  constexpr double kShort = 1e-6;
  const double size = diagonal > 0.0 ? diagonal : 1.0;
  const double far = points.size() > 0 ? points.cwiseAbs().maxCoeff() : 0.0;
  return std::max(kShort * size, std::sqrt(std::numeric_limits<double>::epsilon() * far * size));
}

/// A unit vector at right angles to each normal; any where there is none.
Points tangents(const Points& normals) {
  Points out(3, normals.cols());
  for (Index i = 0; i < normals.cols(); ++i) {
    const Eigen::Vector3d n = normals.col(i).stableNormalized();
    out.col(i) = n.squaredNorm() > 0.0 ? n.unitOrthogonal() : Eigen::Vector3d::UnitX();
  }
  return out;
}

}  // namespace

Deformation::Deformation(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}

Result<Points> Deformation::transform_points(const Points&) const {
  return Status(ErrorCode::not_solvable,
                "this moves a surface, not the space around it; expected a method that carries points");
}

Result<Points> Deformation::transform_normals(const Points& points, const Points& normals) const {
  const Result<Points> origins = transform_points(points);
  if (!origins.ok()) return origins;
  const double h = difference_step(shape().diagonal(), points);
  const Points first = tangents(normals);
  Points second(3, points.cols());
  for (Index i = 0; i < points.cols(); ++i) second.col(i) = normals.col(i).stableNormalized().cross(first.col(i));
  const Result<Points> along_first = transform_points(points + h * first);
  if (!along_first.ok()) return along_first;
  const Result<Points> along_second = transform_points(points + h * second);
  if (!along_second.ok()) return along_second;
  Points out = normals;
  for (Index i = 0; i < out.cols(); ++i) {
    const Eigen::Vector3d a = (along_first->col(i) - origins->col(i)) / h;
    const Eigen::Vector3d b = (along_second->col(i) - origins->col(i)) / h;
    const Eigen::Vector3d turned = a.cross(b).stableNormalized();
    if (turned.squaredNorm() > 0.0) out.col(i) = normals.col(i).stableNorm() * turned;
  }
  return out;
}

}  // namespace pliant
