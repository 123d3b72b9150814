#include "pliant/deformers/rigid_cells/model.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/disjoint_sets.h"
#include "pliant/geometry/closest_rotation.h"
#include "pliant/geometry/nearest_points.h"

namespace pliant::cells {
namespace {

/// Mean of the points in a cell; of a cell without points, that of the nearest point.
std::vector<double> cell_factors(const CellTree& tree, const Shape& shape, const std::vector<double>& of_points) {
  std::vector<double> sums(tree.size(), 0.0), counts(tree.size(), 0.0);
  for (Index p = 0; p < shape.points().cols(); ++p) {
    const Index cell = tree.cell_at(shape.points().col(p));
    sums[cell] += of_points[p];
    counts[cell] += 1.0;
  }
  const NearestPoints nearest(shape.points());
  std::vector<Index> found;
  std::vector<double> squared;
  for (Index i = 0; i < tree.size(); ++i) {
    if (counts[i] > 0.0) {
      sums[i] /= counts[i];
    } else {
      nearest.find(tree.center(i), 1, found, squared);
      sums[i] = of_points[found[0]];
    }
  }
  return sums;
}

}  // namespace

std::vector<double> point_factors(const Shape& shape, const std::vector<CellStiffness>& regions) {
  std::vector<double> factors(shape.points().cols(), 1.0);
  for (const CellStiffness& region : regions) {
    for (const Index vertex : region.vertices) factors[shape.point_of_vertex()[vertex]] = region.factor;
  }
  return factors;
}

CellModel cell_model(const CellTree& tree, const Shape& shape, const std::vector<double>& point_factors) {
  CellModel model;
  model.origin = tree.frame().center;
  model.centers = tree.centers().colwise() - model.origin;
  for (Index i = 0; i < tree.size(); ++i) {
    model.sides.push_back(tree.side(i));
    model.corners.push_back(tree.corner(i));
  }
  int smallest = model.corners.empty() ? 1 : 1 << 30;
  for (Index i = 0; i < tree.size(); ++i) smallest = std::min(smallest, 1 << (tree.frame().depth - tree.level(i)));
  for (Eigen::Vector3i& corner : model.corners) corner /= smallest;
  model.factors = cell_factors(tree, shape, point_factors);
  for (const CellPair& pair : tree.pairs()) {
    model.pairs.push_back({pair.i, pair.j});
    model.weights.push_back(pair.weight * 0.5 * (model.factors[pair.i] + model.factors[pair.j]));
    model.glue.emplace_back(model.centers.col(pair.i), model.centers.col(pair.j), model.sides[pair.i],
                            model.sides[pair.j], model.weights.back(), tree.frame().dimension);
  }
  return model;
}

std::vector<CellMotion> inherited_motions(const CellModel& before, const std::vector<CellMotion>& motions,
                                          const CellModel& after, const CellTree::Origins& origins) {
  std::vector<CellMotion> result(after.size());
  for (Index i = 0; i < after.size(); ++i) {
    const double share = 1.0 / static_cast<double>(origins[i].size());
    Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();
    for (const Index origin : origins[i]) {
      const CellMotion& motion = motions[origin];
      turns += share * motion.rotation;
      const Eigen::Vector3d arm = after.centers.col(i) - before.centers.col(origin);
      result[i].center += share * (motion.center + motion.rotation * arm);
    }
    result[i].rotation = origins[i].size() == 1 ? turns : closest_rotation(turns);
  }
  return result;
}

std::vector<CellMotion> CellModel::rest() const {
  std::vector<CellMotion> motions(size());
  for (Index i = 0; i < size(); ++i) motions[i].center = centers.col(i);
  return motions;
}

double CellModel::energy(const std::vector<CellMotion>& motions) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < pairs.size(); ++p) sum += glue[p].energy(motions[pairs[p][0]], motions[pairs[p][1]]);
  return sum;
}

std::vector<double> CellModel::strains(const std::vector<CellMotion>& motions) const {
  std::vector<double> energies(size(), 0.0), sums(size(), 0.0);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const double energy = glue[p].energy(motions[pairs[p][0]], motions[pairs[p][1]]);
    for (const Index cell : pairs[p]) {
      energies[cell] += energy;
      sums[cell] += weights[p];
    }
  }
  for (Index i = 0; i < size(); ++i) {
    energies[i] = sums[i] > 0.0 ? std::sqrt(energies[i] / sums[i]) / sides[i] : 0.0;
  }
  return energies;
}

std::vector<Index> CellModel::parts() const {
  DisjointSets sets(size());
  for (const auto& [i, j] : pairs) sets.join(i, j);
  return sets.numbered().of;
}

}  // namespace pliant::cells
