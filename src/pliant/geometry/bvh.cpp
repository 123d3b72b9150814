#include "pliant/geometry/bvh.h"

#include <algorithm>
#include <numeric>

namespace pliant {

Bvh::Bvh(const Points& points, const Triangles& triangles) : order_(triangles.cols()) {
  const Index count = static_cast<Index>(triangles.cols());
  if (count == 0) {
    return;
  }
  const auto box_of = [&](Index t) {
    Box box;
    for (const Index corner : triangles.col(t)) {
      box.extend(points.col(corner));
    }
    return box;
  };
  Points centers(3, count);
  for (Index t = 0; t < count; ++t) {
    centers.col(t) = box_of(t).center();
  }
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(count);
  build(0, count, centers);

  boxes_.reserve(count);
  for (const Index t : order_) {
    boxes_.push_back(box_of(t));
  }
  // Children follow their parents, so the boxes fill from the back.
  for (Index n = static_cast<Index>(nodes_.size()) - 1; n >= 0; --n) {
    Node& node = nodes_[n];
    if (node.count == 0) {
      node.box = nodes_[n + 1].box.merged(nodes_[node.second].box);
    }
    for (Index i = node.first; i < node.first + node.count; ++i) {
      node.box.extend(boxes_[i]);
    }
  }
}

Index Bvh::build(Index first, Index last, const Points& centers) {
  const Index n = static_cast<Index>(nodes_.size());
  nodes_.push_back({Box(), first, last - first, 0});
  if (last - first <= kLeafSize) {
    return n;
  }
  Box spread;
  for (Index i = first; i < last; ++i) {
    spread.extend(centers.col(order_[i]));
  }
  int axis = 0;
  spread.sizes().maxCoeff(&axis);
  const Index middle = std::midpoint(first, last);
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](Index s, Index t) { return centers(axis, s) < centers(axis, t); });
  nodes_[n].count = 0;
  build(first, middle, centers);
  const Index second = build(middle, last, centers);
  nodes_[n].second = second;
  return n;
}

}  // namespace pliant
