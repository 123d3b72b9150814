// The points of a set nearest to a place.
#pragma once

#include <memory>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// A k-d tree. Keeps a reference to the points, which must not be none.
class NearestPoints {
 public:
  explicit NearestPoints(const Points& points);
  ~NearestPoints();

  /// The `count` nearest ones (fewer where there are not so many), nearest first, and their squared
  /// distances. Overwrites both lists.
  void find(const Eigen::Vector3d& place, Index count, std::vector<Index>& found, std::vector<double>& squared) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace pliant
