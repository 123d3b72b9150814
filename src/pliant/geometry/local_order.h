// An order that keeps neighbours together in memory.
#pragma once

#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// The points (3 x n) along a Z-order curve through their bounding box: order[rank] = point. Loops
/// over a scan in the order of its file wait for memory two thirds of their time.
/// Source: Morton 1966.
std::vector<Index> local_order(const Points& points);

}  // namespace pliant
