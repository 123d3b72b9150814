// Points that are held end where they are held, whatever the map of the cells makes of them.
#pragma once

#include <vector>

#include "pliant/core/types.h"
#include "pliant/solve/carry.h"

namespace pliant::cells {

/// A map through the centres of cells passes held points by a part of a cell. What is missing there
/// is added, and fades out around them: a modified Shepard interpolation (Franke and Little) of what
/// the nearest pins miss, which is met at each of them and does not jump anywhere.
class Pins {
 public:
  /// rest: 3 x h, distinct; reach: how far from the pins their correction ends.
  void set_up(Points rest, double reach);
  void set_targets(Points targets) { targets_ = std::move(targets); }

  const Points& rest() const { return rest_; }
  const Points& targets() const { return targets_; }

  /// Points within reach, and the pins they follow.
  struct Reached {
    std::vector<Index> points;
    Influences pins;
  };
  Reached reached(const Points& points) const;

  /// Adds to carried points what the pins miss: 3 x h, a target less where the pin was carried.
  static void add(const Reached& reached, const Points& missed, Points& carried);

 private:
  Points rest_ = Points(3, 0), targets_ = Points(3, 0);
  double reach_ = 0.0;
};

}  // namespace pliant::cells
