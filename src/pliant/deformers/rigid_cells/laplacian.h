// Smooth guesses over cells: what follows which handle by how much, and where centres go when turns
// are known.
#pragma once

#include <vector>

#include "pliant/deformers/rigid_cells/model.h"

namespace pliant::cells {

/// 1 at some cells, 0 at the others that are held, harmonic between; to about three digits.
/// held: of each cell.
Eigen::VectorXd harmonic_shares(const CellModel& model, const std::vector<bool>& held, const std::vector<Index>& of);

/// Moves the centres of cells that are not held to where the energy is least with the rotations as
/// they are; to about five digits of what is missing.
void settle_centers(const CellModel& model, const std::vector<bool>& held, std::vector<CellMotion>& motions);

}  // namespace pliant::cells
