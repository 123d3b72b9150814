// A tree of axis-aligned boxes over triangles: which of them can touch.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "pliant/core/types.h"

namespace pliant {

/// Built once for fixed positions; keeps no reference to them. Memory: about 100 bytes a triangle.
class Bvh {
 public:
  Bvh(const Points& points, const Triangles& triangles);

  /// Calls visit(s, t), s < t, once for every pair of triangles whose boxes touch.
  template <class Visit>
  void for_each_touching_pair(Visit&& visit) const {
    if (!nodes_.empty()) {
      pairs_within(0, visit);
    }
  }

 private:
  using Box = Eigen::AlignedBox3d;

  /// A leaf holds order_[first] .. order_[first + count - 1]; an inner node has count 0, its
  /// children are the next node and `second`.
  struct Node {
    Box box;
    Index first = 0;
    Index count = 0;
    Index second = 0;
  };

  static constexpr Index kLeafSize = 4;

  Index build(Index first, Index last, const Points& centers);

  template <class Visit>
  void pairs_within(Index n, Visit& visit) const {
    const Node& node = nodes_[n];
    if (node.count == 0) {
      pairs_within(n + 1, visit);
      pairs_within(node.second, visit);
      pairs_between(n + 1, node.second, visit);
      return;
    }
    for (Index i = 0; i < node.count; ++i) {
      for (Index j = i + 1; j < node.count; ++j) {
        visit_if_touching(node.first + i, node.first + j, visit);
      }
    }
  }

  template <class Visit>
  void pairs_between(Index m, Index n, Visit& visit) const {
    const Node& a = nodes_[m];
    const Node& b = nodes_[n];
    if (!a.box.intersects(b.box)) {
      return;
    }
    if (a.count > 0 && b.count > 0) {
      for (Index i = 0; i < a.count; ++i) {
        for (Index j = 0; j < b.count; ++j) {
          visit_if_touching(a.first + i, b.first + j, visit);
        }
      }
    } else if (b.count > 0 || (a.count == 0 && a.box.sizes().sum() > b.box.sizes().sum())) {
      pairs_between(m + 1, n, visit);
      pairs_between(a.second, n, visit);
    } else {
      pairs_between(m, n + 1, visit);
      pairs_between(m, b.second, visit);
    }
  }

  template <class Visit>
  void visit_if_touching(Index i, Index j, Visit& visit) const {
    if (boxes_[i].intersects(boxes_[j])) {
      visit(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
    }
  }

  std::vector<Node> nodes_;
  std::vector<Index> order_;  ///< triangles, leaf by leaf
  std::vector<Box> boxes_;    ///< of the triangles, in that order
};

}  // namespace pliant
