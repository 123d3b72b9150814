#include "pliant/geometry/patch.h"

namespace pliant {

Patches::Patches(const Shape& shape)
    : shape_(shape), triangles_(triangles_of_points(shape.triangles(), static_cast<Index>(shape.points().cols()))) {}

std::vector<Index> Patches::around(const Points& positions, std::span<const Spot> spots, double radius) const {
  const Triangles& triangles = shape_.triangles();
  const Index count = triangles_.rows();
  const bool scattered = triangles.size() < count;
  std::vector<Index> reached_from(count, -1);  // the last spot that has reached a point
  std::vector<Index> open;
  for (Index s = 0; s < static_cast<Index>(spots.size()); ++s) {
    const auto& [seed, center] = spots[s];
    const auto reach = [&, s, &center = center](Index point) {
      if (reached_from[point] == s || (positions.col(point) - center).norm() > radius) return;
      reached_from[point] = s;
      open.push_back(point);
    };
    reached_from[seed] = s;
    open = {seed};
    if (scattered) {
      for (Index point = 0; point < count; ++point) reach(point);
      continue;
    }
    while (!open.empty()) {
      const Index point = open.back();
      open.pop_back();
      for (const Index t : triangles_.row(point)) {
        for (const Index corner : triangles.col(t)) reach(corner);
      }
    }
  }
  std::vector<Index> patch;
  for (Index point = 0; point < count; ++point) {
    if (reached_from[point] >= 0) patch.push_back(point);
  }
  return patch;
}

}  // namespace pliant
