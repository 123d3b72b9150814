// Keeps parameters of a region from jumping where it joins its neighbours.
#pragma once

#include <array>
#include <span>

#include "pliant/core/types.h"

namespace pliant {

/// On the inner side of a bend the closest point of the curve may be far along it right beside the
/// part the region joins: the surface between would be torn. Moves values of free points as little
/// as needed so that none differs from that of a pinned point by more than slack + rate times their
/// distance along edges. values: of the free points; pinned: of the pinned ones; ids and edges as
/// in ParameterSmoother. Nothing is done, at the cost of a look at the edges, where no neighbour of
/// a pinned point differs that much.
void tether(const Points& points, std::span<const Index> point_of_local, std::span<const std::array<Index, 2>> edges,
            std::span<const double> pinned, double slack, double rate, std::span<double> values);

}  // namespace pliant
