// The checked door for all input: meshes of any kind, polygon soup, points without faces, the
// plane. Behind it positions are finite, indices in range and duplicates welded; later code only
// asserts.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/core/types.h"

namespace pliant {

/// What the door found. Counts of edges and components are those of the welded shape.
struct ShapeReport {
  Index vertices = 0;              ///< vertices of the input
  Index triangles = 0;             ///< triangles of the input, degenerate ones included
  Index components = 0;            ///< connected through shared edges; an isolated point is one
  Index boundary_edges = 0;        ///< edges with one triangle
  Index non_manifold_edges = 0;    ///< edges with more than two triangles
  Index degenerate_triangles = 0;  ///< fewer than three distinct points, or no area
  Index welded_vertices = 0;       ///< input vertices that share the position of an earlier one
};

/// A shape at rest, immutable. Input vertices at exactly equal positions become one point inside;
/// everything that leaves is scattered back to the input's vertices.
class Shape {
 public:
  /// Checks and welds.
  /// positions: dimension * n coordinates, vertex by vertex. triangles: 3 * m vertex ids, or none.
  /// dimension: 3, or 2 for the plane (points get z = 0).
  /// Errors: invalid_shape (no vertices, length not a multiple, non-finite, beyond max_coordinate,
  /// smaller than min_extent, index out of range), too_large (more than max_vertices or
  /// max_triangles).
  static Result<std::shared_ptr<const Shape>> create(std::span<const double> positions,
                                                     std::span<const std::uint32_t> triangles, int dimension = 3);

  static constexpr Index kMaxVertices = 8'000'000;
  static constexpr Index kMaxTriangles = 4 * kMaxVertices;
  /// Within these bounds no area, volume or product of two of them overflows or vanishes, so that
  /// nothing behind the door has to care. min_extent: of the longest side of the bounding box,
  /// unless all points coincide.
  static constexpr double kMaxCoordinate = 1e30;
  static constexpr double kMinExtent = 1e-30;
  /// A triangle whose shortest height is below this part of the diagonal counts as having no area.
  static constexpr double kNoHeight = 1e-12;

  int dimension() const { return dimension_; }
  Index input_size() const { return static_cast<Index>(point_of_vertex_.size()); }
  /// 3 x p welded points, in order of first appearance in the input unless `in_local_order`.
  const Points& points() const { return points_; }
  /// 3 x m' triangles over the points; those with fewer than three distinct points are left out.
  const Triangles& triangles() const { return triangles_; }
  /// Input vertex -> point.
  const std::vector<Index>& point_of_vertex() const { return point_of_vertex_; }
  /// Point -> first input vertex at it.
  const std::vector<Index>& vertex_of_point() const { return vertex_of_point_; }
  const ShapeReport& report() const { return report_; }
  /// Diagonal of the bounding box, in the input's unit; 0 only when all points coincide.
  double diagonal() const { return diagonal_; }
  /// Unit normals of the points (area-weighted; zero where there is no triangle), 3 x p.
  Points normals() const;
  /// The same shape with its points along a curve that keeps neighbours together (local_order.h),
  /// its triangles after them: what walks over points and edges again and again is up to three
  /// times as fast. Nothing that leaves through `scatter` tells the difference.
  std::shared_ptr<const Shape> in_local_order() const;
  /// 3 x p values of the points -> 3 x n values of the input's vertices.
  Points scatter(const Points& of_points) const;
  /// The input's vertices at some points, ascending.
  std::vector<Index> vertices_at(std::span<const Index> points) const;

 private:
  Shape() = default;
  void weld(std::span<const double> positions);
  void keep_triangles(std::span<const std::uint32_t> triangles);
  void fill_report(Index input_triangles);

  int dimension_ = 3;
  Points points_;
  Triangles triangles_;
  std::vector<Index> point_of_vertex_;
  std::vector<Index> vertex_of_point_;
  ShapeReport report_;
  double diagonal_ = 0.0;
};

}  // namespace pliant
