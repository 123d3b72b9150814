#include "pliant/geometry/adjacency.h"

#include <numeric>
#include <utility>

#include "pliant/core/disjoint_sets.h"

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
  for_each_edge(triangles, triangles_of_points(triangles, points),
                [&](Index a, Index b, std::span<const Index> sharing) {
                  edges.ends.push_back({a, b});
                  edges.triangles.items.insert(edges.triangles.items.end(), sharing.begin(), sharing.end());
                  edges.triangles.offsets.push_back(static_cast<Index>(edges.triangles.items.size()));
                });
  return edges;
}

int corner_across(const Triangles& triangles, Index t, Index a, Index b) {
  int c = 0;
  while (triangles(c, t) == a || triangles(c, t) == b) ++c;
  return c;
}

bool walks_along(const Triangles& triangles, Index t, Index a, Index b) {
  for (int c = 0; c < 3; ++c) {
    if (triangles(c, t) == a && triangles((c + 1) % 3, t) == b) return true;
  }
  return false;
}

Components connected_components(const Triangles& triangles, const Incidence& around) {
  DisjointSets sets(static_cast<Index>(triangles.cols()));
  for_each_edge(triangles, around, [&](Index, Index, std::span<const Index> sharing) {
    for (const Index t : sharing.subspan(1)) sets.join(sharing.front(), t);
  });
  auto [count, of_triangle] = sets.numbered();
  for (Index p = 0; p < around.rows(); ++p) count += around.row(p).empty();
  return {count, std::move(of_triangle)};
}

}  // namespace pliant
