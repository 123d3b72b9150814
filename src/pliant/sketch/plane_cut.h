// Cutting a part of a mesh along a plane: the loops in which the plane meets it, which of them are
// needed, and the natural boundary near them. Kho and Garland, section 4.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// One connected run of triangles that the plane crosses.
struct CutLoop {
  std::vector<Index> triangles;
  Points crossings;     ///< where the plane meets their edges, 3 x k
  double length = 0.0;  ///< of the line in which the plane meets them
};

/// Of every point the smallest id among those it hangs together with through the triangles.
std::vector<Index> connected_points(const Triangles& triangles, Index points);

/// Where a triangle lies: outside the cut part, or on one side of the cut.
enum class CutSide : std::uint8_t { outside, behind, ahead };

class PlaneCut {
 public:
  /// points: 3 x p; part: the triangles to cut, ascending ids; distance: signed, of every point
  /// from the plane (at least 0 is ahead). Keeps references to all of them.
  PlaneCut(const Points& points, const Triangles& triangles, std::span<const Index> part,
           std::span<const double> distance);

  const std::vector<CutLoop>& loops() const { return loops_; }

  /// Chooses the loops to cut along: `first`, and of the others, in order, those without which the
  /// two parts that `first` separates would be one. What the part's other components are is
  /// outside. Returns the loops, ascending. connected: the part is one component; a single loop
  /// then parts it as the plane does, and nothing is searched.
  const std::vector<Index>& separate(Index first, bool connected = false);

  /// The side of every triangle of the part after `separate` as the plane itself has it: a crossed
  /// one goes with two of its corners.
  std::vector<CutSide> sides_of_plane() const;

  /// The side of every triangle of the part after `separate`, along the cheapest boundary through
  /// the triangles within `band` of the plane that hang together with the loops: edges cost their
  /// length, less where the surface is creased, least where it is creased inwards.
  /// Where the band leaves nothing on a side, the plane itself decides.
  std::vector<CutSide> sides(double band) const;

 private:
  bool is_ahead(Index point) const { return ahead_[point] != 0; }
  bool is_crossed(Index triangle) const;
  void find_loops();
  void find_pieces();
  /// Pieces that a loop joins: points that hang together on one side of the plane.
  Index behind(const CutLoop& loop) const { return piece_of(loop, false); }
  Index ahead(const CutLoop& loop) const { return piece_of(loop, true); }
  Index piece_of(const CutLoop& loop, bool ahead) const;

  const Points& points_;
  const Triangles& triangles_;
  std::span<const Index> part_;
  std::span<const double> distance_;
  std::vector<std::uint8_t> ahead_;  ///< whether a point is; bytes, which a triangle's corners read quickly
  std::vector<CutLoop> loops_;
  std::vector<Index> piece_;   ///< of every point, after `separate`
  std::vector<CutSide> side_;  ///< of every point, after `separate`
  std::vector<Index> kept_;
};

/// What it costs to cut along an edge between the triangles with corners (a, b, c) and (b, a, d):
/// length (1 - eta bend / pi), with bend the angle between their normals, eta 1 where the surface
/// is creased inwards and 0.2 where outwards; never below 1 % of the length.
double cut_cost(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace pliant
