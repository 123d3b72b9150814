#include "pliant/geometry/adjacency.h"

#include <numeric>

namespace pliant {

Incidence triangles_of_points(const Triangles& triangles, Index points) {
  Incidence around;
  around.offsets.assign(points + 1, 0);
  for (const Index corner : triangles.reshaped()) {
    ++around.offsets[corner + 1];
  }
  std::partial_sum(around.offsets.begin(), around.offsets.end(), around.offsets.begin());

  around.items.resize(triangles.size());
  std::vector<Index> next(around.offsets.begin(), around.offsets.end() - 1);
  for (Index t = 0; t < triangles.cols(); ++t) {
    for (const Index corner : triangles.col(t)) {
      around.items[next[corner]++] = t;
    }
  }
  return around;
}

EdgeTable unique_edges(const Triangles& triangles, Index points) {
  EdgeTable edges;
  edges.triangles.items.reserve(triangles.size());
  for_each_edge(
      triangles, triangles_of_points(triangles, points),
      [&](Index a, Index b, std::span<const Index> sharing) {
        edges.ends.push_back({a, b});
        edges.triangles.items.insert(edges.triangles.items.end(), sharing.begin(), sharing.end());
        edges.triangles.offsets.push_back(static_cast<Index>(edges.triangles.items.size()));
      });
  return edges;
}

namespace {

/// Root of an element's tree; halves the path on the way.
Index find_root(std::vector<Index>& parent, Index element) {
  while (parent[element] != element) {
    parent[element] = parent[parent[element]];
    element = parent[element];
  }
  return element;
}

}  // namespace

Components connected_components(const Triangles& triangles, const Incidence& around) {
  std::vector<Index> parent(triangles.cols());
  std::iota(parent.begin(), parent.end(), 0);
  for_each_edge(triangles, around, [&](Index, Index, std::span<const Index> sharing) {
    for (const Index t : sharing.subspan(1)) {
      const Index a = find_root(parent, sharing.front());
      const Index b = find_root(parent, t);
      // The lower id becomes the root, so that roots are met first below.
      parent[std::max(a, b)] = std::min(a, b);
    }
  });

  Components parts;
  parts.of_triangle.resize(triangles.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Index root = find_root(parent, t);
    parts.of_triangle[t] = root == t ? parts.count++ : parts.of_triangle[root];
  }
  for (Index p = 0; p < around.rows(); ++p) {
    parts.count += around.row(p).empty();
  }
  return parts;
}

}  // namespace pliant
