#include "pliant/geometry/cotangent.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace pliant {

Points half_cotangents(const Points& points, const Triangles& triangles) {
  Points weights(3, triangles.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    Eigen::Matrix3d edge;  // across each corner
    for (int c = 0; c < 3; ++c) {
      edge.col(c) = points.col(triangles((c + 2) % 3, t)) - points.col(triangles((c + 1) % 3, t));
    }
    const double longest = edge.colwise().squaredNorm().maxCoeff();
    const double area = std::max(edge.col(0).cross(edge.col(1)).norm(), kLeastHeight * longest);
    for (int c = 0; c < 3; ++c) {
      weights(c, t) = -0.5 * edge.col((c + 1) % 3).dot(edge.col((c + 2) % 3)) / area;
    }
  }
  return weights;
}

std::vector<double> cotangent_weights(const Points& half_cotangents, const Triangles& triangles,
                                      const EdgeTable& edges) {
  std::vector<double> weights(edges.size(), 0.0);
  for (Index e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    for (Index t : edges.triangles.row(e)) weights[e] += half_cotangents(corner_across(triangles, t, a, b), t);
  }
  return weights;
}

}  // namespace pliant
