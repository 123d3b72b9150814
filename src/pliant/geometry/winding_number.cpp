#include "pliant/geometry/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "pliant/geometry/normals.h"

namespace pliant {
namespace {

constexpr Index kLeafSize = 8;
/// A part is far when it is this many of its radii away.
constexpr double kFar = 2.3;

}  // namespace

WindingNumber::WindingNumber(const Points& points, const Triangles& triangles)
    : points_(points), triangles_(triangles), order_(triangles.cols()) {
  const Index count = static_cast<Index>(triangles.cols());
  if (count == 0) return;
  Points centers(3, count);
  for (Index t = 0; t < count; ++t) centers.col(t) = points(Eigen::all, triangles.col(t)).rowwise().mean();
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(count);
  build(0, count, centers, triangle_area_vectors(points, triangles) / 2.0);
}

Index WindingNumber::build(Index first, Index last, const Points& centers, const Points& area_vectors) {
  Node node;
  node.first = first;
  node.count = last - first;
  Eigen::Vector3d low = centers.col(order_[first]), high = low;
  double weight = 0.0;
  for (Index i = first; i < last; ++i) {
    const Index t = order_[i];
    const double area = area_vectors.col(t).norm();
    node.area += area_vectors.col(t);
    node.center += area * centers.col(t);
    weight += area;
    low = low.cwiseMin(centers.col(t));
    high = high.cwiseMax(centers.col(t));
  }
  node.center = weight > 0.0 ? Eigen::Vector3d(node.center / weight) : Eigen::Vector3d((low + high) / 2.0);
  double squared = 0.0;
  for (Index i = first; i < last; ++i) {
    for (const Index corner : triangles_.col(order_[i])) {
      squared = std::max(squared, (points_.col(corner) - node.center).squaredNorm());
    }
  }
  node.radius = std::sqrt(squared);
  const Index n = static_cast<Index>(nodes_.size());
  nodes_.push_back(node);
  if (last - first <= kLeafSize) return n;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const Index middle = std::midpoint(first, last);
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](Index s, Index t) { return centers(axis, s) < centers(axis, t); });
  nodes_[n].count = 0;
  build(first, middle, centers, area_vectors);
  const Index second = build(middle, last, centers, area_vectors);
  nodes_[n].second = second;
  return n;
}

double WindingNumber::solid_angle(Index triangle, const Eigen::Vector3d& place) const {
  // Van Oosterom and Strackee 1983.
  const Eigen::Vector3d a = points_.col(triangles_(0, triangle)) - place;
  const Eigen::Vector3d b = points_.col(triangles_(1, triangle)) - place;
  const Eigen::Vector3d c = points_.col(triangles_(2, triangle)) - place;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

double WindingNumber::at(const Eigen::Vector3d& place) const {
  double angle = 0.0;
  std::vector<Index> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    const Index n = open.back();
    open.pop_back();
    const Eigen::Vector3d away = node.center - place;
    const double distance = away.norm();
    if (distance > kFar * node.radius) {
      angle += node.area.dot(away) / (distance * distance * distance);
    } else if (node.count == 0) {
      open.push_back(n + 1);
      open.push_back(node.second);
    } else {
      for (Index i = 0; i < node.count; ++i) angle += solid_angle(order_[node.first + i], place);
    }
  }
  return angle / (4.0 * std::numbers::pi);
}

}  // namespace pliant
