// What constraints hold of the cells they touch (Botsch 2007, section 4).
#pragma once

#include <vector>

#include "pliant/deformers/rigid_cells/model.h"
#include "pliant/deformers/rigid_cells/multigrid.h"
#include "pliant/solve/handle.h"

namespace pliant::cells {

/// A cell that is held: whole, or at one point of it.
struct Hold {
  Index cell = 0;
  Freedom freedom = Freedom::held;
  CellMotion motion;              ///< where it is held whole, about the origin
  Eigen::Vector3d point, target;  ///< the point that is held, at rest and now, about the origin
};

/// Holds of the cells that fixed points and handles touch, by cell. A cell follows the rigid motion
/// closest to that of its points: by the turn of their handle, and where several share it or a handle
/// is bent, by their own. `hold` points, and handles on one line (a single vertex is the most common)
/// that say nothing of a turn, leave it free to turn about one point. Targets alone decide.
std::vector<Hold> find_holds(const CellModel& model, const Shape& shape, const std::vector<Index>& cell_of_point,
                             const std::vector<Index>& fixed, const std::vector<Handle>& handles, CellHold hold);

/// Where the centre of a cell is that is turned so and held at a point; exactly at rest where nothing
/// has moved.
Eigen::Vector3d held_center(const Hold& hold, const CellModel& model, const Eigen::Matrix3d& rotation);

/// Puts held cells where they are held; the others stay.
void apply(const std::vector<Hold>& holds, const CellModel& model, std::vector<CellMotion>& motions);

}  // namespace pliant::cells
