#include "pliant/geometry/triangle_crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace pliant {
namespace {

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool overlaps(const Interval& other, double tolerance) const {
    return std::min(high, other.high) - std::max(low, other.low) > tolerance;
  }
};

Interval extent(const Eigen::Matrix3d& triangle, const Eigen::Vector3d& direction) {
  const Eigen::RowVector3d along = direction.transpose() * triangle;
  return {along.minCoeff(), along.maxCoeff()};
}

/// Unit normal, or zero for a triangle no higher than the tolerance.
Eigen::Vector3d normal_of(const Eigen::Matrix3d& triangle, double tolerance) {
  const Eigen::Vector3d u = triangle.col(1) - triangle.col(0);
  const Eigen::Vector3d v = triangle.col(2) - triangle.col(0);
  const Eigen::Vector3d cross = u.cross(v);
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  const double doubled_area = cross.norm();
  return doubled_area > tolerance * longest ? Eigen::Vector3d(cross / doubled_area)
                                            : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

/// Distances of the corners from the plane through `origin`; contacts are zero.
Eigen::RowVector3d heights(const Eigen::Matrix3d& triangle, const Eigen::Vector3d& normal,
                           const Eigen::Vector3d& origin, double tolerance) {
  Eigen::RowVector3d height = normal.transpose() * (triangle.colwise() - origin);
  return (height.array().abs() > tolerance).select(height, 0.0);
}

/// Where the triangle meets the plane its corners have these heights over, along `line`.
Interval section(const Eigen::Matrix3d& triangle, const Eigen::RowVector3d& height, const Eigen::Vector3d& line) {
  Interval met;
  const Eigen::RowVector3d along = line.transpose() * triangle;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (height[i] == 0.0) {
      met.add(along[i]);
    } else if (height[i] * height[j] < 0.0) {
      met.add(along[i] + (along[j] - along[i]) * height[i] / (height[i] - height[j]));
    }
  }
  return met;
}

bool overlap_in_plane(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Vector3d& normal,
                      double tolerance) {
  for (const Eigen::Matrix3d* triangle : {&a, &b}) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d side = triangle->col((i + 1) % 3) - triangle->col(i);
      const Eigen::Vector3d across = normal.cross(side).normalized();
      if (!extent(a, across).overlaps(extent(b, across), tolerance)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

bool triangles_cross(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double tolerance) {
  const Eigen::Vector3d normal_a = normal_of(a, tolerance);
  const Eigen::RowVector3d height_b = heights(b, normal_a, a.col(0), tolerance);
  const auto one_sided = [](const Eigen::RowVector3d& height) {
    return height.minCoeff() >= 0.0 || height.maxCoeff() <= 0.0;
  };
  if (one_sided(height_b) && !height_b.isZero(0.0)) {
    return false;
  }
  const Eigen::Vector3d normal_b = normal_of(b, tolerance);
  if (normal_a.isZero(0.0) || normal_b.isZero(0.0)) {
    return false;
  }
  if (height_b.isZero(0.0)) {
    return overlap_in_plane(a, b, normal_a, tolerance);
  }
  const Eigen::RowVector3d height_a = heights(a, normal_b, b.col(0), tolerance);
  if (one_sided(height_a)) {
    return false;
  }
  const Eigen::Vector3d line = normal_a.cross(normal_b).normalized();
  return section(a, height_a, line).overlaps(section(b, height_b, line), tolerance);
}

}  // namespace pliant
