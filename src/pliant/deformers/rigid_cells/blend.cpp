#include "pliant/deformers/rigid_cells/blend.h"

#include <algorithm>
#include <cmath>

#include "pliant/geometry/nearest_points.h"

namespace pliant::cells {
namespace {

constexpr Index kNearest = 4;

}  // namespace

Influences nearest_cells(const Points& centers, const Points& points) {
  const NearestPoints tree(centers);
  Influences all;
  all.k = std::min<int>(kNearest, static_cast<int>(centers.cols()));
  std::vector<Index> found;
  std::vector<double> squared;
  for (Index p = 0; p < points.cols(); ++p) {
    tree.find(points.col(p), all.k, found, squared);
    // At a centre that cell alone.
    const double least = squared[0];
    double sum = 0.0;
    for (std::size_t i = 0; i < squared.size(); ++i) {
      squared[i] = least > 0.0 ? std::sqrt(least / squared[i]) : (i == 0 ? 1.0 : 0.0);
      sum += squared[i];
    }
    for (const double weight : squared) all.weights.push_back(weight / sum);
    all.indices.insert(all.indices.end(), found.begin(), found.end());
  }
  return all;
}

PackedMaps cell_maps(const Points& centers, const std::vector<CellMotion>& motions) {
  PackedMaps maps(12, centers.cols());
  for (Index i = 0; i < centers.cols(); ++i) {
    const Eigen::Matrix3d turn = motions[i].rotation - Eigen::Matrix3d::Identity();
    maps.col(i) = pack_map(turn, (motions[i].center - centers.col(i)) - turn * centers.col(i));
  }
  return maps;
}

}  // namespace pliant::cells
