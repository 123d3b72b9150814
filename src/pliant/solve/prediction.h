// Where to start from when targets have moved: parts of the shape that nothing fixes follow the
// rigid motion of their handles, the rest the turns of the handles, spread as smoothly as the
// method's matrix can. What has less energy than the deformation that stands is kept.
#pragma once

#include <vector>

#include "pliant/core/types.h"
#include "pliant/solve/constraints.h"

namespace pliant {

/// What a method can be asked to try. Moved points are numbered as Constraints::moved_points.
class Start {
 public:
  virtual ~Start() = default;

  /// Turns of handles below this (radians) need no prediction.
  virtual double small_turn() const = 0;
  /// Where a moved point stands, 3 numbers in the input's unit, before it is held at its target.
  virtual Eigen::Vector3d standing(Index moved) const = 0;

  /// Pieces of the shape that are not connected with each other, and which of them nothing fixes.
  virtual Index part_count() const = 0;
  virtual bool floats(Index part) const = 0;
  /// The part of a moved point; -1 where it is fixed.
  virtual Index part_of(Index moved) const = 0;

  /// Moves the parts that are listed rigidly, if that lowers the energy.
  struct PartMotion {
    Index part;
    RigidMotion motion;
  };
  virtual void try_rigid(const std::vector<PartMotion>& motions) = 0;
  /// Turns everything along with the handles (one rotation vector each); if that lowers the energy,
  /// or in any case.
  virtual void try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) = 0;
};

/// Starts a deformation anew towards the targets of `constraints`, whose turns it takes.
void predict(Constraints& constraints, Start& start);

}  // namespace pliant
