// The preview: points follow the cells nearest to them (Botsch 2007, section 6).
#pragma once

#include <array>
#include <vector>

#include "pliant/deformers/rigid_cells/energy.h"

namespace pliant::cells {

/// Of each point the four nearest cells (fewer where there are not so many), weighted by the inverse
/// distance to their centres.
struct Followed {
  std::array<Index, 4> cells{};
  std::array<double, 4> weights{};
};

/// centers: of the cells; points: 3 x n, both in the scene.
std::vector<Followed> followed_cells(const Points& centers, const Points& points);

/// out = deformed points, exactly the points where nothing has moved. motions: about `origin`.
void blend(const std::vector<Followed>& followed, const Points& centers, const std::vector<CellMotion>& motions,
           const Eigen::Vector3d& origin, const Points& points, Points& out);

}  // namespace pliant::cells
