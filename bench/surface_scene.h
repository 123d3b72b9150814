// The edit that the benches of surface methods share: one side of a torus fixed, the other turned
// by 60 degrees and moved, 3 % of the points each.
#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "pliant/solve/deformer.h"
#include "support/shapes.h"

namespace pliant::bench {

struct SurfaceScene {
  test::Mesh mesh;
  std::shared_ptr<const Shape> shape;
  std::vector<Index> fixed, moved;
  Motion motion;

  explicit SurfaceScene(test::Mesh of) : mesh(std::move(of)) {
    shape = *Shape::create(mesh.positions, mesh.triangles);
    std::vector<Index> order(mesh.vertices());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return mesh.vertex(a).x() < mesh.vertex(b).x(); });
    const std::size_t part = order.size() * 3 / 100;
    fixed.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(part));
    moved.assign(order.end() - static_cast<std::ptrdiff_t>(part), order.end());
    motion.axis = {0.2, 1.0, 0.1};
    motion.angle = 1.05;
    motion.about = mesh.vertex(order.back());
    motion.translation = 0.1 * shape->diagonal() * Eigen::Vector3d(0, 0, 1);
  }

  void grab(Deformer& deformer) const {
    if (!deformer.set_fixed(fixed).ok() || !deformer.add_handle(moved).ok()) std::abort();
  }
  void drag(Deformer& deformer, double fraction = 1.0) const {
    Motion now = motion;
    now.angle *= fraction;
    now.translation *= fraction;
    if (!deformer.move_handle(1, now).ok()) std::abort();
  }
};

}  // namespace pliant::bench
