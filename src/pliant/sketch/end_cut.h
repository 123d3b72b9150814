// Where the two ends of a reference stroke cut the shape it lies on: planes across it. Kho and
// Garland, section 4.2.
#pragma once

#include <span>
#include <vector>

#include "pliant/sketch/laid_stroke.h"
#include "pliant/sketch/plane_cut.h"

namespace pliant {

/// A plane that contains the view's direction.
struct ScreenLine {
  Eigen::Vector2d point;   ///< view coordinates
  Eigen::Vector2d normal;  ///< unit, ahead
};

/// Signed, of every point.
std::vector<double> distances(const SeenShape& shape, const ScreenLine& line);

/// Triangles within this of a cutting plane may lie on either side of the cut (section 4.2.1): 5
/// pixels, in view coordinates.
double cut_band(const SeenShape& shape, const LaidStroke& stroke);

/// The shape cut across one end of the stroke.
struct EndCut {
  double s = 0.0;  ///< where on the stroke
  std::vector<CutSide>
      sides;  ///< of every triangle of the part; towards the stroke's end is ahead. Empty: nothing is cut
};

class EndCutter {
 public:
  /// part: triangles of one component, ascending. Keeps references to all of them.
  EndCutter(const SeenShape& shape, const LaidStroke& stroke, std::span<const Index> part)
      : shape_(shape), stroke_(stroke), part_(part) {}

  /// The side on which every triangle of the part lies of the plane across the stroke at s: the loop there alone
  /// counts. Empty: none is there.
  std::vector<CutSide> sides_of_plane(double s) const;

  /// A plane that would run through more than the limb (its loop comes near to quite other places
  /// of the stroke) moves along the stroke, at most over 40 % of it, until it crosses the limb
  /// alone.
  EndCut limb_start() const;
  EndCut limb_end() const;

 private:
  /// What a plane across the stroke meets of the limb.
  struct Section {
    bool there = false;
    bool narrow = false;  ///< lies near its place along the stroke
    double length = 0.0;
  };

  EndCut cut(double s) const;
  Eigen::Vector3d anchor(double s) const;
  Index loop_at(const std::vector<CutLoop>& loops, double s) const;
  bool is_section(const CutLoop& loop, double s) const;
  ScreenLine across(double s) const;
  Section section_at(double s) const;

  const SeenShape& shape_;
  const LaidStroke& stroke_;
  std::span<const Index> part_;
};

}  // namespace pliant
