#include "pliant/deformers/embedded_graph/refine.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "pliant/geometry/closest_rotation.h"
#include "pliant/solve/carry.h"

namespace pliant::embedded {
namespace {

/// A node stands out when its terms exceed the mean by this factor.
constexpr double kStandsOut = 2.0;
/// New nodes keep this share of the mean edge length from all others.
constexpr double kClosest = 0.25;
constexpr double kLeastDeterminant = 0.2;

/// Nodes whose weighted rotation and regularisation terms stand out.
std::vector<bool> strained_nodes(const GraphSolver& solver) {
  const std::vector<double> energies = solver.energy().node_energies(solver.x());
  double mean = 0.0;
  for (const double energy : energies) mean += energy / static_cast<double>(energies.size());
  std::vector<bool> strained(energies.size());
  for (std::size_t j = 0; j < energies.size(); ++j) strained[j] = mean > 1e-12 && energies[j] > kStandsOut * mean;
  return strained;
}

}  // namespace

Points nodes_to_add(const Shape& shape, const DeformationGraph& graph, const GraphSolver& solver, Index max_nodes) {
  const std::vector<bool> strained = strained_nodes(solver);
  std::vector<Index> candidates;
  std::vector<double> distance;  // squared, to the nearest node so far
  const int k = graph.influences.k;
  for (Index i = 0; i < shape.points().cols(); ++i) {
    const Index nearest = graph.influences.indices[static_cast<std::size_t>(i) * k];
    if (!strained[nearest]) continue;
    candidates.push_back(i);
    distance.push_back((shape.points().col(i) - graph.nodes.col(nearest)).squaredNorm());
  }
  const double closest = std::pow(kClosest * graph.length_unit, 2);
  std::vector<Index> chosen;
  while (!candidates.empty() && static_cast<Index>(chosen.size()) < max_nodes) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest < closest) break;
    const Index point = candidates[farthest - distance.begin()];
    chosen.push_back(point);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double d = (shape.points().col(candidates[i]) - shape.points().col(point)).squaredNorm();
      distance[i] = std::min(distance[i], d);
    }
  }
  return shape.points()(Eigen::all, chosen);
}

Pose inherited_pose(const Shape& shape, const DeformationGraph& old_graph, const Pose& old_pose,
                    const DeformationGraph& refined) {
  const Index kept = old_graph.size();
  const double rescale = old_graph.length_unit / refined.length_unit;
  Pose pose(12, refined.size());
  pose.leftCols(kept) = old_pose;
  const Points fresh = refined.nodes.rightCols(refined.size() - kept);
  const Influences influences = compute_influences(shape, old_graph, fresh);
  const Points g = old_graph.scaled(old_graph.nodes), p = old_graph.scaled(fresh);
  for (Index i = 0; i < fresh.cols(); ++i) {
    Eigen::Matrix3d u = Eigen::Matrix3d::Zero();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
    for (int s = 0; s < influences.k; ++s) {
      const std::size_t at = static_cast<std::size_t>(i) * influences.k + s;
      const Index j = influences.indices[at];
      const Eigen::Matrix3d uj = gradient_of(old_pose, j);
      u += influences.weights[at] * uj;
      t += influences.weights[at] * (uj * (p.col(i) - g.col(j)) + translation_of(old_pose, j));
    }
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + u;
    if (r.determinant() < kLeastDeterminant) u = closest_rotation(r) - Eigen::Matrix3d::Identity();
    for (int a = 0; a < 3; ++a) pose.col(kept + i).segment<4>(4 * a) << u(a, 0), u(a, 1), u(a, 2), t[a];
  }
  for (int a = 0; a < 3; ++a) pose.row(4 * a + 3) *= rescale;
  return pose;
}

}  // namespace pliant::embedded
