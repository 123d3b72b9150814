#include "pliant/geometry/normals.h"

#include <Eigen/Geometry>

namespace pliant {

Points triangle_area_vectors(const Points& points, const Triangles& triangles) {
  Points vectors(3, triangles.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d a = points.col(triangles(0, t));
    const Eigen::Vector3d b = points.col(triangles(1, t));
    const Eigen::Vector3d c = points.col(triangles(2, t));
    vectors.col(t) = (b - a).cross(c - a);
  }
  return vectors;
}

Points point_normals(const Points& points, const Triangles& triangles) {
  const Points vectors = triangle_area_vectors(points, triangles);
  Points normals = Points::Zero(3, points.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    for (const Index corner : triangles.col(t)) {
      normals.col(corner) += vectors.col(t);
    }
  }
  for (auto normal : normals.colwise()) {
    normal.normalize();  // leaves zero zero
  }
  return normals;
}

}  // namespace pliant
