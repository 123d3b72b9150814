// Points sorted into the cells of a regular grid, to find those near a place.
#pragma once

#include <cstdint>

#include "pliant/geometry/adjacency.h"

namespace pliant {

/// Keeps a reference to the points. The grid is unbounded: cells are hashed into as many buckets as
/// there are points.
class PointGrid {
 public:
  /// reach: the largest distance a query may ask for, at least 1e-15 of the extent of the points.
  PointGrid(const Points& points, double reach);

  /// Calls visit(point, squared distance) for every point closer to `center` than `reach`; a point
  /// may be visited more than once.
  template <class Visit>
  void for_each_near(const Eigen::Vector3d& center, Visit&& visit) const {
    const Cell middle = cell_of(center);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          for (const Index i : buckets_.row(static_cast<Index>(bucket(middle + Cell(dx, dy, dz))))) {
            const double squared = (points_.col(i) - center).squaredNorm();
            if (squared < cell_ * cell_) {
              visit(i, squared);
            }
          }
        }
      }
    }
  }

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

  Cell cell_of(const Eigen::Vector3d& p) const;
  std::uint32_t bucket(const Cell& cell) const;

  const Points& points_;
  Eigen::Vector3d origin_;
  double cell_;
  std::uint64_t mask_;
  Incidence buckets_;
};

}  // namespace pliant
