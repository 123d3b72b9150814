#include "pliant/deformers/rigid_cells/pins.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/geometry/nearest_points.h"

namespace pliant::cells {
namespace {

/// Pins that a point follows.
constexpr int kNearest = 8;

/// Weights of the pins at distances whose squares are given, nearest first, that sum to what is left
/// of their correction there. A pin as far away as `end` has none.
std::vector<double> shares(const std::vector<double>& squared, int used, double end, double reach) {
  std::vector<double> weights(used, 0.0);
  if (squared[0] == 0.0) {
    weights[0] = 1.0;
    return weights;
  }
  double sum = 0.0;
  for (int s = 0; s < used; ++s) {
    const double distance = std::sqrt(squared[s]), closeness = std::max(0.0, end - distance) / (end * distance);
    weights[s] = closeness * closeness;
    sum += weights[s];
  }
  const double fade = 1.0 - squared[0] / (reach * reach);
  for (double& weight : weights) weight = fade * fade * (sum > 0.0 ? weight / sum : 1.0 / used);
  return weights;
}

}  // namespace

void Pins::set_up(Points rest, double reach) {
  rest_ = std::move(rest);
  targets_ = rest_;
  reach_ = reach;
}

Pins::Reached Pins::reached(const Points& points) const {
  Reached result;
  if (rest_.cols() == 0) return result;
  const NearestPoints tree(rest_);
  const int used = result.pins.k = std::min<int>(kNearest, static_cast<int>(rest_.cols()));
  std::vector<Index> found;
  std::vector<double> squared;
  for (Index p = 0; p < points.cols(); ++p) {
    tree.find(points.col(p), used + 1, found, squared);
    if (!(squared[0] < reach_ * reach_)) continue;
    const bool more = static_cast<int>(found.size()) > used;
    // Where there are no others, all of them count, however far.
    const double end = more ? std::sqrt(squared[used]) : 2.0 * std::sqrt(squared[used - 1]);
    result.points.push_back(p);
    result.pins.indices.insert(result.pins.indices.end(), found.begin(), found.begin() + used);
    const std::vector<double> weights = shares(squared, used, end, reach_);
    result.pins.weights.insert(result.pins.weights.end(), weights.begin(), weights.end());
  }
  return result;
}

void Pins::add(const Reached& reached, const Points& missed, Points& carried) {
  const int k = reached.pins.k;
  const Index* pin = reached.pins.indices.data();
  const double* weight = reached.pins.weights.data();
  for (const Index point : reached.points) {
    for (int s = 0; s < k; ++s) carried.col(point) += *weight++ * missed.col(*pin++);
  }
}

}  // namespace pliant::cells
