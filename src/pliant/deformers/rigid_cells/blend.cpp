#include "pliant/deformers/rigid_cells/blend.h"

#include <cmath>

#include "pliant/geometry/nearest_points.h"

namespace pliant::cells {

std::vector<Followed> followed_cells(const Points& centers, const Points& points) {
  const NearestPoints nearest(centers);
  std::vector<Followed> all(points.cols());
  std::vector<Index> found;
  std::vector<double> squared;
  for (Index p = 0; p < points.cols(); ++p) {
    nearest.find(points.col(p), 4, found, squared);
    if (squared[0] == 0.0) found.resize(1);
    double sum = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      all[p].cells[k] = found[k];
      all[p].weights[k] = squared[0] == 0.0 ? 1.0 : std::sqrt(squared[0] / squared[k]);
      sum += all[p].weights[k];
    }
    for (double& weight : all[p].weights) weight /= sum;
  }
  return all;
}

void blend(const std::vector<Followed>& followed, const Points& centers, const std::vector<CellMotion>& motions,
           const Eigen::Vector3d& origin, const Points& points, Points& out) {
  out.resize(3, points.cols());
  for (Index p = 0; p < points.cols(); ++p) {
    Eigen::Vector3d move = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k) {
      const Index cell = followed[p].cells[k];
      const Eigen::Vector3d arm = points.col(p) - centers.col(cell);
      const CellMotion& motion = motions[cell];
      move += followed[p].weights[k] * ((motion.rotation * arm - arm) + (motion.center - (centers.col(cell) - origin)));
    }
    out.col(p) = points.col(p) + move;
  }
}

}  // namespace pliant::cells
