// Polylines in a plane: strokes in pixels, and curves that know their turning angles.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pliant/core/types.h"

namespace pliant {

/// Points of a plane, one a column, 2 x n: a stroke in pixels (y down), or a curve in scene units.
using Polyline = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// Sum of the lengths of the segments.
double length_of(const Polyline& line);

/// `nodes` >= 2 points at equal distances along the line, both ends among them. Chords across a
/// bend are shorter than others.
Polyline sampled(const Polyline& line, Index nodes);

/// `nodes` >= 2 points along the line with both ends kept, all segments equally long (to 1e-6).
/// `line` has at least two points and some length.
Polyline resampled(const Polyline& line, Index nodes);

/// The value at s in [0, 1] of a function that is linear between evenly spaced `values`, two at
/// least.
double linear_in(const std::vector<double>& values, double s);

/// A polyline of equal steps given by where it starts and how it turns: what a bend compares,
/// adjusts and interpolates. Kho and Garland, "Sketching Mesh Deformations" (2005), section 5.1.
class PlaneCurve {
 public:
  PlaneCurve() = default;
  /// Through `nodes` >= 3 points of equal steps (see `resampled`).
  explicit PlaneCurve(Polyline nodes);
  /// Rebuilt from its first node, the direction of its first segment (radians, from x to y), the
  /// exterior angles at its n - 2 inner nodes and its step.
  PlaneCurve(const Eigen::Vector2d& start, double heading, std::vector<double> turns, double step);

  const Polyline& nodes() const { return nodes_; }
  Index size() const { return static_cast<Index>(nodes_.cols()); }
  double heading() const { return heading_; }                  ///< radians, (-pi, pi]
  const std::vector<double>& turns() const { return turns_; }  ///< radians, (-pi, pi], n - 2
  double step() const { return step_; }                        ///< length of a segment
  double length() const { return step_ * static_cast<double>(size() - 1); }

  /// The point at normalised arc length s in [0, 1].
  Eigen::Vector2d point(double s) const;
  /// The total turning angle Phi(s), eq. 1-4, from the first segment on. The ends, where the paper
  /// has no turn, turn like their neighbours: a circle keeps its curvature up to its ends.
  double turning(double s) const { return linear_in(totals_, s); }
  /// Phi at the nodes and the middles between them, 2 n - 1 values: linear in s between.
  const std::vector<double>& totals() const { return totals_; }

  /// Skinning: s of the point of the curve nearest to p.
  double nearest(const Eigen::Vector2d& p) const;

  /// The curve moved so that it starts at `start`.
  PlaneCurve starting_at(const Eigen::Vector2d& start) const;

 private:
  struct Block {
    Eigen::Vector2d low, high;
  };
  void derive();

  Polyline nodes_;
  double heading_ = 0.0;
  double step_ = 0.0;
  std::vector<double> turns_;
  std::vector<double> totals_;  ///< Phi at the nodes and the middles between: 2 n - 1 values
  std::vector<Block> blocks_;   ///< boxes around runs of segments
};

/// a - b as an angle in (-pi, pi].
double angle_between(double a, double b);

}  // namespace pliant
