// What a Sketch holds; shared by its sources only.
#pragma once

#include "pliant/sketch/limb.h"
#include "pliant/sketch/sketch.h"

namespace pliant {

struct SketchModel {
  std::shared_ptr<const Shape> shape;
  std::optional<Plane> mirror;
  bool smooth = true;
  Hold hold = Hold::larger;
  bool held_at_end = false;
  Polyline reference_pixels;  ///< filtered, as drawn
  double start = 0.0;         ///< fraction of it, from the held end, and of targets, before the region
  std::vector<Limb> limbs;    ///< one, or a second one that is its reflection

  /// As drawn or set: without the turning control.
  SketchPose base;
  Profile turning = Profile::identity();
  Profile twist_speed = Profile::identity();
  double twist_angle = 0.0;
  double morph = 1.0;

  Points world;  ///< points of the shape, then those added, in the pose shown
  std::optional<Refinement> refinement;
  std::vector<Index> point_of_added;  ///< of the vertices the refinement added

  const PlaneCurve& curve() const { return limbs.front().reference(); }
  /// The base pose with the turning control, eq. 8.
  SketchPose whole_pose() const;
  /// New parameters, then `show`. A preview may be off by what no eye sees.
  void pose_changed(bool preview = false);
  /// Places of all points.
  void show();
  Status find_joints();
  /// Point of a vertex, added ones included.
  Index point_of(Index vertex) const;
  Points of_vertices(const Points& of_points) const;
  /// Over points, the refinement's if there is one.
  Triangles triangles() const;
  /// A curve on the plane of a limb, in space: 3 x nodes.
  static Points in_space(const Limb& limb, const PlaneCurve& curve);
  /// The limb that moves a point, or the first.
  const Limb& limb_of(Index point) const;
};

}  // namespace pliant
