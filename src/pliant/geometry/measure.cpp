#include "pliant/geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/bvh.h"
#include "pliant/geometry/normals.h"
#include "pliant/geometry/triangle_crossing.h"

namespace pliant {
namespace {

constexpr double kFoldCosine = -0.5;
constexpr double kContact = 1e-10;  // of the diagonal: two triangles that close only touch

double diagonal_of(const Points& points) { return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm(); }

Eigen::Matrix3d corners(const Points& points, const Triangles& triangles, Index t) {
  Eigen::Matrix3d result;
  for (int corner = 0; corner < 3; ++corner) {
    result.col(corner) = points.col(triangles(corner, t));
  }
  return result;
}

/// Linear between the two values around place q (count - 1) of the sorted ones. Reorders.
double quantile(std::vector<double>& values, double q) {
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), below, values.end());
  const double low = *below;
  const double high = below + 1 == values.end() ? low : *std::min_element(below + 1, values.end());
  return low + (high - low) * (place - std::floor(place));
}

void measure_stretch(const EdgeTable& edges, const Points& rest, const Points& deformed, Quality& quality) {
  if (edges.size() == 0) {
    return;
  }
  std::vector<double> stretch;
  stretch.reserve(edges.ends.size());
  double sum = 0.0;
  for (const auto [a, b] : edges.ends) {
    const double before = (rest.col(a) - rest.col(b)).norm();
    const double after = (deformed.col(a) - deformed.col(b)).norm();
    stretch.push_back(std::abs(after / before - 1.0));
    sum += stretch.back();
  }
  quality.stretch_mean = sum / edges.size();
  quality.stretch_max = *std::max_element(stretch.begin(), stretch.end());
  quality.stretch_p95 = quantile(stretch, 0.95);
}

/// In radians; 0 where a side has no length.
double angle_at(const Eigen::Matrix3d& triangle, int corner) {
  const Eigen::Vector3d u = triangle.col((corner + 1) % 3) - triangle.col(corner);
  const Eigen::Vector3d v = triangle.col((corner + 2) % 3) - triangle.col(corner);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Mean change of the corner angles, degrees.
double shear(const Triangles& triangles, const Points& rest, const Points& deformed) {
  if (triangles.cols() == 0) {
    return 0.0;
  }
  double sum = 0.0;
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Matrix3d before = corners(rest, triangles, t);
    const Eigen::Matrix3d after = corners(deformed, triangles, t);
    for (int corner = 0; corner < 3; ++corner) {
      sum += std::abs(angle_at(after, corner) - angle_at(before, corner));
    }
  }
  return sum / static_cast<double>(triangles.size()) * 180.0 / std::numbers::pi;
}

/// Whether the surface bounds something: every edge is walked as often one way as the other.
bool is_closed(const Triangles& triangles, const EdgeTable& edges) {
  for (Index e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    int balance = 0;
    for (const Index t : edges.triangles.row(e)) {
      bool forwards = false;
      for (int corner = 0; corner < 3; ++corner) {
        forwards |= triangles(corner, t) == a && triangles((corner + 1) % 3, t) == b;
      }
      balance += forwards ? 1 : -1;
    }
    if (balance != 0) {
      return false;
    }
  }
  return edges.size() > 0;
}

double signed_volume(const Points& points, const Triangles& triangles) {
  const Eigen::Vector3d center = points.rowwise().mean();
  double volume = 0.0;
  for (Index t = 0; t < triangles.cols(); ++t) {
    volume += (corners(points, triangles, t).colwise() - center).determinant() / 6.0;
  }
  return volume;
}

/// More than rounding.
bool is_volume(double volume, const Shape& shape) {
  return std::abs(volume) > Shape::kNoHeight * std::pow(shape.diagonal(), 3);
}

Index count_folds(const EdgeTable& edges, const Points& area_vectors_rest, const Points& area_vectors) {
  const auto cosine = [](const Points& vectors, Index s, Index t) {
    const double lengths = vectors.col(s).norm() * vectors.col(t).norm();
    return lengths > 0.0 ? vectors.col(s).dot(vectors.col(t)) / lengths : 0.0;
  };
  Index folds = 0;
  for (Index e = 0; e < edges.size(); ++e) {
    const std::span<const Index> sides = edges.triangles.row(e);
    folds += sides.size() == 2 && cosine(area_vectors, sides[0], sides[1]) < kFoldCosine &&
             cosine(area_vectors_rest, sides[0], sides[1]) >= kFoldCosine;
  }
  return folds;
}

Index count_new_crossings(const Triangles& triangles, const Points& rest, const Points& deformed) {
  const double contact_rest = kContact * diagonal_of(rest);
  const double contact_deformed = kContact * diagonal_of(deformed);
  Index count = 0;
  Bvh(deformed, triangles).for_each_touching_pair([&](Index s, Index t) {
    for (const Index corner : triangles.col(s)) {
      if ((triangles.col(t).array() == corner).any()) {
        return;
      }
    }
    const auto cross = [&](const Points& points, double tolerance) {
      return triangles_cross(corners(points, triangles, s), corners(points, triangles, t), tolerance);
    };
    if (count < std::numeric_limits<Index>::max() && cross(deformed, contact_deformed) && !cross(rest, contact_rest)) {
      ++count;
    }
  });
  return count;
}

/// Root mean square, over the points with edges, of the way along the normal from a point to the
/// mean of its neighbours.
double roughness(const EdgeTable& edges, const Points& points, const Points& normals) {
  Points sum = Points::Zero(3, points.cols());
  std::vector<Index> valence(points.cols(), 0);
  for (const auto [a, b] : edges.ends) {
    sum.col(a) += points.col(b) - points.col(a);
    sum.col(b) += points.col(a) - points.col(b);
    ++valence[a];
    ++valence[b];
  }
  double squares = 0.0;
  Index count = 0;
  for (Index p = 0; p < points.cols(); ++p) {
    if (valence[p] > 0) {
      const double along_normal = normals.col(p).dot(sum.col(p)) / valence[p];
      squares += along_normal * along_normal;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

std::optional<double> enclosed_volume(const Shape& shape) {
  const Triangles& triangles = shape.triangles();
  const double volume = signed_volume(shape.points(), triangles);
  if (!is_volume(volume, shape)) return {};
  if (!is_closed(triangles, unique_edges(triangles, static_cast<Index>(shape.points().cols())))) return {};
  return volume;
}

Quality measure_quality(const Shape& shape, const Points& deformed, bool with_intersections) {
  const Points& rest = shape.points();
  const Triangles& triangles = shape.triangles();
  const double diagonal = shape.diagonal();
  assert(deformed.cols() == rest.cols());
  Quality quality;
  if (triangles.cols() == 0) {
    return quality;
  }
  const EdgeTable edges = unique_edges(triangles, static_cast<Index>(rest.cols()));
  measure_stretch(edges, rest, deformed, quality);
  quality.shear = shear(triangles, rest, deformed);

  const Points area_vectors_rest = triangle_area_vectors(rest, triangles);
  const Points area_vectors = triangle_area_vectors(deformed, triangles);
  quality.folds = count_folds(edges, area_vectors_rest, area_vectors);
  const double doubled_area = area_vectors_rest.colwise().norm().sum();
  if (doubled_area > Shape::kNoHeight * diagonal * diagonal) {
    quality.area = area_vectors.colwise().norm().sum() / doubled_area;
  }
  const double volume = signed_volume(rest, triangles);
  if (is_volume(volume, shape) && is_closed(triangles, edges)) {
    quality.volume = signed_volume(deformed, triangles) / volume;
  }
  quality.roughness_rest = roughness(edges, rest, point_normals(rest, triangles)) / diagonal;
  quality.roughness = roughness(edges, deformed, point_normals(deformed, triangles)) / diagonal;
  if (with_intersections) {
    quality.intersections = count_new_crossings(triangles, rest, deformed);
  }
  return quality;
}

}  // namespace pliant
