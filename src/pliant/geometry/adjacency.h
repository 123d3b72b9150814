// Who touches whom: triangles around points, unique edges with their triangles, components.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pliant/core/sort.h"
#include "pliant/core/types.h"

namespace pliant {

/// Rows of varying length in two flat arrays: row i is items[offsets[i]] .. items[offsets[i + 1] -
/// 1].
struct Incidence {
  std::vector<Index> offsets = {0};  ///< rows + 1
  std::vector<Index> items;

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> row(Index i) const {
    return {items.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
  }
};

/// Row p: the triangles with corner p, ascending. `triangles`: three distinct points each, ids
/// below `points`.
Incidence triangles_of_points(const Triangles& triangles, Index points);

/// Calls visit(a, b, span of triangles, ascending) once an edge, a < b, edges in ascending order.
/// `around`: triangles_of_points of the same triangles.
template <class Visit>
void for_each_edge(const Triangles& triangles, const Incidence& around, Visit&& visit) {
  std::vector<Keyed> ends;  // the other end, triangle
  std::vector<Index> sharing;
  for (Index a = 0; a < around.rows(); ++a) {
    ends.clear();
    for (const Index t : around.row(a)) {
      for (const Index b : triangles.col(t)) {
        if (b > a) {
          ends.push_back({key_of(0, b), t});
        }
      }
    }
    sort_keyed(ends);
    for (std::size_t i = 0; i < ends.size();) {
      const std::uint64_t b = ends[i].key;
      sharing.clear();
      for (; i < ends.size() && ends[i].key == b; ++i) {
        sharing.push_back(ends[i].index);
      }
      visit(a, static_cast<Index>(b), std::span<const Index>(sharing));
    }
  }
}

/// Every edge once, with the triangles it belongs to.
struct EdgeTable {
  std::vector<std::array<Index, 2>> ends;  ///< a < b, ascending
  Incidence triangles;                     ///< row e: triangles of edge e, ascending

  Index size() const { return static_cast<Index>(ends.size()); }
};

EdgeTable unique_edges(const Triangles& triangles, Index points);

/// The corner of triangle t that is neither of two others.
int corner_across(const Triangles& triangles, Index t, Index a, Index b);
/// Whether triangle t runs through its edge a, b from a to b.
bool walks_along(const Triangles& triangles, Index t, Index a, Index b);

/// Parts connected through shared edges (two parts that touch at a point only stay two); a point
/// without triangles is a part of its own.
struct Components {
  Index count = 0;
  std::vector<Index> of_triangle;  ///< 0 .. , in order of the first triangle of each
};

Components connected_components(const Triangles& triangles, const Incidence& around);

}  // namespace pliant
