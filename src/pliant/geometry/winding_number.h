// The generalised winding number: how often a surface, closed or not, goes around a place.
#pragma once

#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// About 1 inside a surface whose normals point outwards, about 0 outside, and in between near holes
/// (Jacobson, Kavan, Sorkine-Hornung: Robust Inside-Outside Segmentation, 2013). Far parts of the
/// surface count as one dipole each (Barill et al.: Fast Winding Numbers, 2018): within 0.05.
class WindingNumber {
 public:
  /// Keeps references to both.
  WindingNumber(const Points& points, const Triangles& triangles);

  double at(const Eigen::Vector3d& place) const;

 private:
  /// As in Bvh: a leaf holds order_[first] .. order_[first + count - 1], an inner node has count 0.
  struct Node {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the triangles, weighted by area
    Eigen::Vector3d area = Eigen::Vector3d::Zero();    ///< sum of their area vectors
    double radius = 0.0;                               ///< of a ball about the centre that holds them
    Index first = 0, count = 0, second = 0;
  };

  Index build(Index first, Index last, const Points& centers, const Points& area_vectors);
  double solid_angle(Index triangle, const Eigen::Vector3d& place) const;

  const Points& points_;
  const Triangles& triangles_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace pliant
