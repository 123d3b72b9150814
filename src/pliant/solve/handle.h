// Handles: sets of vertices the user moves, and the motions they are moved by.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "pliant/core/named_values.h"

namespace pliant {

using HandleId = int;

/// The script's TRANSFORM, from rest: scale about `center`, then turn about an axis through
/// `about`, then translate. The angle counts turns: 270 degrees is not -90.
struct Motion {
  double scale = 1.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< need not be unit, must not be zero
  double angle = 0.0;                               ///< radians, right-handed, any size
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  /// The motion as one map of space.
  Eigen::Affine3d map() const;
  Eigen::Vector3d apply(const Eigen::Vector3d& p) const { return map() * p; }
};

void exchange(NamedFields& fields, Motion& motion);

/// Turn from one motion to another about the same axis, axis times angle, of any size; zero where
/// they do not share one or the earlier one is not known.
Eigen::Vector3d turn_between(const std::optional<Motion>& before, const Motion& after);

/// One set of vertices and where it should go. Points, not input vertices: copies at one position
/// are one point, the first input vertex stands for all.
struct Handle {
  HandleId id = 0;
  std::vector<Index> points;     ///< ids of the shape's points, in the caller's order
  Points rest;                   ///< 3 x |points|
  Points targets;                ///< 3 x |points|, equal to rest until moved
  std::optional<Motion> motion;  ///< set when the targets come from one: it knows its turns
};

}  // namespace pliant
