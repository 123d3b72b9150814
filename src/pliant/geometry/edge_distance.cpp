#include "pliant/geometry/edge_distance.h"

namespace pliant {

void spread_distances(const Points& points, const Triangles& triangles, const Incidence& around, double reach,
                      std::vector<double>& values) {
  const auto for_each_neighbour = [&](Index i, const auto& visit) {
    for (const Index t : around.row(i)) {
      for (const Index j : triangles.col(t)) {
        if (j != i) visit(j, (points.col(j) - points.col(i)).norm());
      }
    }
  };
  spread_distances(for_each_neighbour, reach, values);
}

}  // namespace pliant
