#include "pliant/geometry/shape.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/core/sort.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/local_order.h"
#include "pliant/geometry/normals.h"

namespace pliant {
namespace {

Status invalid(Words reason) { return {ErrorCode::invalid_shape, message(reason)}; }

Status check_length(const char* argument, std::size_t length, int width) {
  if (length % width != 0) {
    return invalid({argument, " has length ", length, "; expected a multiple of ", width});
  }
  return {};
}

Status check_count(const char* argument, const char* unit, std::size_t count, Index limit) {
  if (count > static_cast<std::size_t>(limit)) {
    return {ErrorCode::too_large, message({argument, " has ", count, " ", unit, "; expected at most ", limit})};
  }
  return {};
}

Status check_positions(std::span<const double> positions, int dimension) {
  if (dimension != 2 && dimension != 3) {
    return invalid({"dimension is ", dimension, "; expected 2 or 3"});
  }
  if (positions.empty()) {
    return invalid({"positions is empty; expected at least one vertex"});
  }
  if (Status status = check_length("positions", positions.size(), dimension); !status.ok()) {
    return status;
  }
  if (Status status = check_count("positions", "vertices", positions.size() / dimension, Shape::kMaxVertices);
      !status.ok()) {
    return status;
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // Written so that NaN fails too.
    if (!(std::abs(positions[i]) <= Shape::kMaxCoordinate)) {
      const std::string expected =
          std::isfinite(positions[i]) ? message({"a magnitude of at most ", Shape::kMaxCoordinate}) : "a finite number";
      return invalid({"positions[", i, "] is ", positions[i], "; expected ", expected});
    }
  }
  return {};
}

Status check_triangles(std::span<const std::uint32_t> triangles, std::size_t vertices) {
  if (Status status = check_length("triangles", triangles.size(), 3); !status.ok()) {
    return status;
  }
  if (Status status = check_count("triangles", "triangles", triangles.size() / 3, Shape::kMaxTriangles); !status.ok()) {
    return status;
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] >= vertices) {
      return invalid({"triangles[", i, "] is ", triangles[i], "; expected a vertex id below ", vertices});
    }
  }
  return {};
}

/// Finds points by exact position: open addressing, at most half full.
class PointTable {
 public:
  explicit PointTable(Index capacity) : slots_(std::bit_ceil(2 * static_cast<std::size_t>(capacity)), -1) {}

  /// The id of the point at `position`, or -1 after entering it under `id`. `points` holds those
  /// entered before.
  Index find_or_enter(const Eigen::Vector3d& position, Index id, const Points& points) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(position) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] < 0) {
        slots_[slot] = id;
        return -1;
      }
      if (points.col(slots_[slot]) == position) {
        return slots_[slot];
      }
    }
  }

 private:
  static std::size_t hash(const Eigen::Vector3d& position) {
    std::uint64_t mixed = 0;
    for (const double coordinate : position) {
      mixed = (mixed ^ Eigen::numext::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
      mixed ^= mixed >> 32;
    }
    return static_cast<std::size_t>(mixed);
  }

  std::vector<Index> slots_;
};

Index count_without_area(const Points& points, const Triangles& triangles, double diagonal) {
  const Points area_vectors = triangle_area_vectors(points, triangles);
  Index count = 0;
  for (Index t = 0; t < triangles.cols(); ++t) {
    double longest = 0.0;
    for (int corner = 0; corner < 3; ++corner) {
      longest =
          std::max(longest, (points.col(triangles(corner, t)) - points.col(triangles((corner + 1) % 3, t))).norm());
    }
    count += area_vectors.col(t).norm() <= Shape::kNoHeight * diagonal * longest;
  }
  return count;
}

}  // namespace

Result<std::shared_ptr<const Shape>> Shape::create(std::span<const double> positions,
                                                   std::span<const std::uint32_t> triangles, int dimension) {
  if (Status status = check_positions(positions, dimension); !status.ok()) {
    return status;
  }
  if (Status status = check_triangles(triangles, positions.size() / dimension); !status.ok()) {
    return status;
  }
  const std::shared_ptr<Shape> shape(new Shape);
  shape->dimension_ = dimension;
  shape->weld(positions);

  const Eigen::Vector3d extent = shape->points_.rowwise().maxCoeff() - shape->points_.rowwise().minCoeff();
  if (shape->points_.cols() > 1 && extent.maxCoeff() < kMinExtent) {
    return invalid(
        {"positions span ", extent.maxCoeff(), "; expected at least ", kMinExtent, ", or one position only"});
  }
  shape->diagonal_ = extent.norm();
  shape->keep_triangles(triangles);
  shape->fill_report(static_cast<Index>(triangles.size() / 3));
  return std::shared_ptr<const Shape>(shape);
}

void Shape::weld(std::span<const double> positions) {
  const Index vertices = static_cast<Index>(positions.size() / dimension_);
  points_ = Points::Zero(3, vertices);
  point_of_vertex_.reserve(vertices);
  PointTable table(vertices);
  for (Index v = 0; v < vertices; ++v) {
    const Index next = static_cast<Index>(vertex_of_point_.size());
    for (int axis = 0; axis < dimension_; ++axis) {
      // Adding zero turns -0 into 0, which the table would tell apart.
      points_(axis, next) = positions[static_cast<std::size_t>(v) * dimension_ + axis] + 0.0;
    }
    const Index found = table.find_or_enter(points_.col(next), next, points_);
    if (found < 0) {
      vertex_of_point_.push_back(v);
    }
    point_of_vertex_.push_back(found < 0 ? next : found);
  }
  points_.conservativeResize(3, static_cast<Index>(vertex_of_point_.size()));
}

void Shape::keep_triangles(std::span<const std::uint32_t> triangles) {
  triangles_.resize(3, static_cast<Index>(triangles.size() / 3));
  Index kept = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Index a = point_of_vertex_[triangles[i]];
    const Index b = point_of_vertex_[triangles[i + 1]];
    const Index c = point_of_vertex_[triangles[i + 2]];
    if (a != b && b != c && c != a) {
      triangles_.col(kept++) << a, b, c;
    }
  }
  triangles_.conservativeResize(3, kept);
}

void Shape::fill_report(Index input_triangles) {
  const Index points = static_cast<Index>(points_.cols());
  report_.vertices = input_size();
  report_.triangles = input_triangles;
  report_.welded_vertices = input_size() - points;
  report_.degenerate_triangles =
      input_triangles - static_cast<Index>(triangles_.cols()) + count_without_area(points_, triangles_, diagonal_);
  const Incidence around = triangles_of_points(triangles_, points);
  report_.components = connected_components(triangles_, around).count;
  for_each_edge(triangles_, around, [this](Index, Index, std::span<const Index> sharing) {
    report_.boundary_edges += sharing.size() == 1;
    report_.non_manifold_edges += sharing.size() > 2;
  });
}

Points Shape::normals() const { return point_normals(points_, triangles_); }

std::shared_ptr<const Shape> Shape::in_local_order() const {
  const std::vector<Index> order = local_order(points_);
  std::vector<Index> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<Index>(i);
  std::shared_ptr<Shape> shape(new Shape(*this));
  shape->points_ = points_(Eigen::all, order);
  for (std::size_t i = 0; i < order.size(); ++i) shape->vertex_of_point_[i] = vertex_of_point_[order[i]];
  for (Index& point : shape->point_of_vertex_) point = rank[point];
  const Triangles ranked = triangles_.unaryExpr([&rank](Index point) { return rank[point]; });
  shape->triangles_ = ranked(Eigen::all, order_by(static_cast<Index>(ranked.cols()),
                                                  [&](Index t) { return key_of(0, ranked.col(t).minCoeff()); }));
  return shape;
}

std::vector<Index> Shape::vertices_at(std::span<const Index> points) const {
  std::vector<bool> wanted(points_.cols(), false);
  for (const Index point : points) wanted[point] = true;
  std::vector<Index> vertices;
  for (Index v = 0; v < input_size(); ++v) {
    if (wanted[point_of_vertex_[v]]) vertices.push_back(v);
  }
  return vertices;
}

Points Shape::scatter(const Points& of_points) const {
  assert(of_points.cols() == points_.cols());
  Points of_vertices(3, input_size());
  for (Index v = 0; v < input_size(); ++v) {
    of_vertices.col(v) = of_points.col(point_of_vertex_[v]);
  }
  return of_vertices;
}

}  // namespace pliant
