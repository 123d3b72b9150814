// The preview: points follow the cells nearest to them (Botsch 2007, section 6).
#pragma once

#include <vector>

#include "pliant/deformers/rigid_cells/energy.h"
#include "pliant/solve/carry.h"

namespace pliant::cells {

/// Of each point the four nearest cells (fewer where there are not so many), weighted by the inverse
/// distance to their centres. centers: of the cells; points: 3 x n, both in the scene.
Influences nearest_cells(const Points& centers, const Points& points);

/// The motions of cells as maps that carry points. centers: about the scene's origin, as motions.
PackedMaps cell_maps(const Points& centers, const std::vector<CellMotion>& motions);

}  // namespace pliant::cells
