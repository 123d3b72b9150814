#include "pliant/deformers/edge_material/field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/cotangent.h"
#include "pliant/geometry/normals.h"
#include "pliant/geometry/point_grid.h"
#include "pliant/solve/local_global.h"

namespace pliant::edge_material {
namespace {

/// Symmetric tensors, one a column: xx, yy, zz, yz, zx, xy.
using Tensors = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Below this part of a tensor's size the difference of its eigenvalues is noise.
constexpr double kEqual = 1e-3;
/// Weights of the harmonic interpolation are at least this, so that it cannot overshoot.
constexpr double kLeastWeight = 1e-3;

Eigen::Matrix<double, 6, 1> outer(const Eigen::Vector3d& d) {
  return {d.x() * d.x(), d.y() * d.y(), d.z() * d.z(), d.y() * d.z(), d.z() * d.x(), d.x() * d.y()};
}

Eigen::Matrix3d matrix_of(const Eigen::Matrix<double, 6, 1>& t) {
  Eigen::Matrix3d m;
  m << t[0], t[5], t[4], t[5], t[1], t[3], t[4], t[3], t[2];
  return m;
}

Eigen::Vector3d tangential(const Eigen::Vector3d& v, const Eigen::Vector3d& normal) {
  return v - v.dot(normal) * normal;
}

/// Unit eigenvector, in the tangent plane, of the eigenvalue that is largest in absolute value;
/// zero where both are equal.
Eigen::Vector3d principal_direction(const Eigen::Matrix3d& tensor, const Eigen::Vector3d& normal) {
  if (normal.isZero(0.0)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const double a = u.dot(tensor * u), b = u.dot(tensor * v), c = v.dot(tensor * v);
  const double size = std::abs(a) + std::abs(b) + std::abs(c);
  if (!(std::hypot(a - c, 2.0 * b) > kEqual * size)) return Eigen::Vector3d::Zero();
  double angle = 0.5 * std::atan2(2.0 * b, a - c);
  if (a + c < 0.0) angle += 0.5 * EIGEN_PI;  // the lower eigenvalue is the larger one
  return std::cos(angle) * u + std::sin(angle) * v;
}

/// The cotangent Laplacian with positive weights.
BlockMatrix laplacian(const Shape& shape, const EdgeTable& edges) {
  const Triangles& triangles = shape.triangles();
  const std::vector<double> weights = cotangent_weights(half_cotangents(shape.points(), triangles), triangles, edges);
  BlockMatrix matrix;
  matrix.set_zero(1, static_cast<Index>(shape.points().cols()), edges.ends);
  for (Index e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    const double weight = std::max(weights[e], kLeastWeight);
    matrix.off_diagonal[e] = -weight;
    matrix.diagonal[a] += weight;
    matrix.diagonal[b] += weight;
  }
  return matrix;
}

double mean_length(const Shape& shape, const EdgeTable& edges) {
  double sum = 0.0;
  for (const auto& [a, b] : edges.ends) sum += (shape.points().col(a) - shape.points().col(b)).norm();
  return sum / edges.size();
}

/// The point closest to a place; `grid` finds it fast where the place is near the shape.
Index nearest_point(const Points& points, const PointGrid& grid, const Eigen::Vector3d& place) {
  Index best = -1;
  double least = std::numeric_limits<double>::infinity();
  auto consider = [&](Index p, double squared) {
    if (squared < least || (squared == least && p < best)) {
      least = squared;
      best = p;
    }
  };
  grid.for_each_near(place, consider);
  if (best >= 0) return best;
  for (Index p = 0; p < points.cols(); ++p) consider(p, (points.col(p) - place).squaredNorm());
  return best;
}

/// The direction of every stroke at the points it passes; zero elsewhere.
Tensors painted_tensors(const Shape& shape, const Points& normals, const std::vector<Points>& strokes, double spacing) {
  const PointGrid grid(shape.points(), 4.0 * spacing);
  Tensors tensors = Tensors::Zero(6, shape.points().cols());
  for (const Points& stroke : strokes) {
    for (Index s = 0; s + 1 < stroke.cols(); ++s) {
      const Eigen::Vector3d from = stroke.col(s), along = stroke.col(s + 1) - from;
      // No more samples than a stroke across the whole shape could need.
      const double most = std::ceil(10.0 * shape.diagonal() / spacing);
      const int steps = static_cast<int>(std::clamp(std::ceil(along.norm() / spacing), 1.0, most));
      for (int k = 0; k <= steps; ++k) {
        const Index p = nearest_point(shape.points(), grid, from + along * k / steps);
        const Eigen::Vector3d d = tangential(along, normals.col(p));
        if (d.norm() > 0.0) tensors.col(p) += outer(d.normalized());
      }
    }
  }
  return tensors;
}

Result<Points> painted_field(const Shape& shape, const EdgeTable& edges, const Points& normals,
                             const std::vector<Points>& strokes) {
  Tensors tensors = painted_tensors(shape, normals, strokes, 0.5 * mean_length(shape, edges));
  const Index n = static_cast<Index>(tensors.cols());
  std::vector<bool> held(n);
  for (Index p = 0; p < n; ++p) {
    const double trace = tensors.col(p).head<3>().sum();
    held[p] = trace > 0.0;
    if (held[p]) tensors.col(p) /= trace;
  }
  // In parts of the shape without a stroke one zero is held, and all are zero.
  const BlockMatrix matrix = laplacian(shape, edges);
  hold_one_a_part(parts_of(matrix), held);
  LocalGlobal interpolation;
  if (Status s = interpolation.set_up(matrix, std::move(held)); !s.ok()) return s;
  for (int half = 0; half < 2; ++half) {
    Points values = tensors.middleRows<3>(3 * half);
    interpolation.extend(values);
    tensors.middleRows<3>(3 * half) = values;
  }
  Points field(3, n);
  for (Index p = 0; p < n; ++p) field.col(p) = principal_direction(matrix_of(tensors.col(p)), normals.col(p));
  return field;
}

Points axis_field(const Points& normals, const Eigen::Vector3d& axis) {
  Points field(3, normals.cols());
  for (Index p = 0; p < field.cols(); ++p) {
    const Eigen::Vector3d d = tangential(axis.normalized(), normals.col(p));
    field.col(p) = d.norm() > kEqual ? Eigen::Vector3d(d.normalized()) : Eigen::Vector3d::Zero();
  }
  return field;
}

Points curvature_field(const Shape& shape, const EdgeTable& edges, const Points& normals, bool largest) {
  const Points areas = triangle_area_vectors(shape.points(), shape.triangles());
  const Index n = static_cast<Index>(normals.cols());
  Tensors ring = Tensors::Zero(6, n), tensors;
  for (Index e = 0; e < edges.size(); ++e) {
    const std::span<const Index> around = edges.triangles.row(e);
    if (around.size() != 2) continue;
    const auto [a, b] = edges.ends[e];
    const Eigen::Vector3d edge = shape.points().col(b) - shape.points().col(a);
    const Eigen::Vector3d u = areas.col(around[0]).normalized(), v = areas.col(around[1]).normalized();
    // Which triangle comes first decides the sign: the one that walks from a to b.
    const double sign = walks_along(shape.triangles(), around[0], a, b) ? 1.0 : -1.0;
    const double angle = std::atan2(sign * edge.normalized().dot(u.cross(v)), u.dot(v));
    ring.col(a) += angle / edge.norm() * outer(edge);
    ring.col(b) += angle / edge.norm() * outer(edge);
  }
  tensors = ring;
  for (const auto& [a, b] : edges.ends) {
    tensors.col(a) += ring.col(b);
    tensors.col(b) += ring.col(a);
  }
  // Angles below this, in all, are rounding of a flat part.
  const double flat = 1e-9 * shape.diagonal();
  Points field(3, n);
  for (Index p = 0; p < n; ++p) {
    // Folded edges lie along the smallest curvature.
    field.col(p).setZero();
    if (tensors.col(p).norm() > flat) field.col(p) = principal_direction(matrix_of(tensors.col(p)), normals.col(p));
    if (largest) field.col(p) = normals.col(p).cross(field.col(p)).eval();
  }
  return field;
}

Result<Points> geodesic_field(const Shape& shape, const EdgeTable& edges, const Points& normals,
                              const std::vector<Index>& sources) {
  // (mass + t Laplacian) u = heat at the sources, t the squared mean edge length.
  const Points areas = triangle_area_vectors(shape.points(), shape.triangles());
  const Triangles& triangles = shape.triangles();
  const double length = mean_length(shape, edges);
  BlockMatrix matrix = laplacian(shape, edges);
  for (double& value : matrix.diagonal) value += 1e-6;  // points of no area
  for (Index t = 0; t < triangles.cols(); ++t) {
    const double third = areas.col(t).norm() / (6.0 * length * length);
    for (Index corner : triangles.col(t)) matrix.diagonal[corner] += third;
  }
  SparseCholesky factor;
  if (Status s = factor.analyze(matrix); !s.ok()) return s;
  if (Status s = factor.factorize(matrix); !s.ok()) return s;
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(matrix.nodes);
  for (Index vertex : sources) heat[shape.point_of_vertex()[vertex]] = 1.0;
  factor.solve(heat.data(), 1);

  Points sum = Points::Zero(3, matrix.nodes);
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d normal = areas.col(t).normalized();
    // Far away heat is tiny: only its course within the triangle matters.
    const double hottest = std::max({heat[triangles(0, t)], heat[triangles(1, t)], heat[triangles(2, t)]});
    if (!(hottest > 0.0)) continue;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d across =
          shape.points().col(triangles((c + 2) % 3, t)) - shape.points().col(triangles((c + 1) % 3, t));
      gradient += heat[triangles(c, t)] / hottest * normal.cross(across);
    }
    if (gradient.norm() == 0.0) continue;
    for (Index corner : triangles.col(t)) sum.col(corner) += areas.col(t).norm() * gradient.normalized();
  }
  Points field(3, matrix.nodes);
  for (Index p = 0; p < matrix.nodes; ++p) field.col(p) = tangential(sum.col(p), normals.col(p)).normalized();
  for (Index vertex : sources) field.col(shape.point_of_vertex()[vertex]).setZero();
  return field;
}

}  // namespace

Result<Points> direction_field(const Shape& shape, const DirectionField& field) {
  using Kind = DirectionField::Kind;
  const Points normals = shape.normals();
  if (field.kind == Kind::none) return Points(Points::Zero(3, normals.cols()));
  if (field.kind == Kind::axis) return axis_field(normals, field.axis);
  const EdgeTable edges = unique_edges(shape.triangles(), static_cast<Index>(normals.cols()));
  if (field.kind == Kind::strokes) return painted_field(shape, edges, normals, field.strokes);
  if (field.kind == Kind::geodesic) return geodesic_field(shape, edges, normals, field.sources);
  return curvature_field(shape, edges, normals, field.kind == Kind::curvature_max);
}

}  // namespace pliant::edge_material
