// What of a shape lies in which boxes of a grid.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pliant/deformers/rigid_cells/frame.h"
#include "pliant/geometry/triangle_box.h"
#include "pliant/geometry/winding_number.h"

namespace pliant::cells {

/// A shape in grid coordinates, made of pieces: the triangles of a mesh or soup and its loose points;
/// of points without triangles, the segments to the nearest others.
class Rasterizer {
 public:
  Rasterizer(const Shape& shape, const GridFrame& frame);

  /// The pieces that meet each coarse cell, x fastest. To be called once, before `inside`.
  std::vector<std::vector<Index>> coarse_cells();
  /// Those of some pieces that meet a box.
  std::vector<Index> meeting(const std::vector<Index>& pieces, const CenteredBox& box) const;
  bool any_meets(const std::vector<Index>& pieces, const CenteredBox& box) const;
  /// Whether the shape's boundary goes through a box, of the pieces that meet it: its surface, in the
  /// plane its outline.
  bool at_boundary(const std::vector<Index>& pieces, const CenteredBox& box) const;
  /// Whether a place that no piece meets is inside the shape. In the plane all that is inside meets
  /// a piece.
  bool inside(const Eigen::Vector3d& place) const;

  const Points& points() const { return points_; }

 private:
  void connect_points();
  void add_loose_points();
  void find_outline();
  void flood_from_outside(const std::vector<std::vector<Index>>& occupied);
  Index coarse_index(const Eigen::Vector3i& cell) const {
    return cell.x() + frame_.counts.x() * (cell.y() + frame_.counts.y() * cell.z());
  }
  Eigen::Matrix3d corners(Index piece) const;

  GridFrame frame_;
  Points points_;
  Triangles pieces_;                    ///< with repeated corners for points and segments
  Triangles surface_;                   ///< the triangles alone
  std::vector<unsigned char> outline_;  ///< of each piece in the plane: bit k, edge k is on the outline
  std::optional<WindingNumber> winding_;
  std::vector<bool> enclosed_;  ///< coarse cells that points enclose
};

}  // namespace pliant::cells
