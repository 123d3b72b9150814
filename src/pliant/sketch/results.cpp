// What a Sketch gives back.
#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/geometry/normals.h"
#include "pliant/geometry/point_grid.h"
#include "pliant/sketch/sketch_model.h"

namespace pliant {

Index SketchModel::point_of(Index vertex) const {
  return vertex < shape->input_size() ? shape->point_of_vertex()[vertex] : point_of_added[vertex - shape->input_size()];
}

Points SketchModel::of_vertices(const Points& of_points) const {
  const Index count = shape->input_size() + static_cast<Index>(point_of_added.size());
  Points result(3, count);
  for (Index v = 0; v < count; ++v) result.col(v) = of_points.col(point_of(v));
  return result;
}

Triangles SketchModel::triangles() const {
  if (!refinement) return shape->triangles();
  Triangles result(3, static_cast<Index>(refinement->triangles.size() / 3));
  for (Index i = 0; i < result.size(); ++i) {
    result(i % 3, i / 3) = point_of(static_cast<Index>(refinement->triangles[i]));
  }
  return result;
}

const Limb& SketchModel::limb_of(Index point) const {
  for (const Limb& limb : limbs) {
    if (limb.moves(point)) return limb;
  }
  return limbs.front();
}

Points SketchModel::in_space(const Limb& limb, const PlaneCurve& curve) {
  Points points(3, curve.size());
  for (Index i = 0; i < curve.size(); ++i) {
    const Eigen::Vector2d xy = curve.nodes().col(i);
    points.col(i) = limb.camera().to_world({xy.x(), xy.y(), limb.depth()});
  }
  return points;
}

const Refinement* Sketch::refinement() const { return impl_->refinement ? &*impl_->refinement : nullptr; }

std::vector<Index> Sketch::labels() const {
  std::vector<Index> labels(impl_->shape->input_size(), kStaticLabel);
  Index rigid_before = 0;
  for (const Limb& limb : impl_->limbs) {
    for (Index v = 0; v < static_cast<Index>(labels.size()); ++v) {
      const Index label = limb.region().of_point[impl_->point_of(v)];
      if (label == kStaticLabel) continue;
      labels[v] = label + (label >= kFirstRigidLabel ? rigid_before : 0);
    }
    rigid_before += limb.region().rigid_parts;
  }
  return labels;
}

std::vector<double> Sketch::parameters() const {
  std::vector<double> s;
  const Index count = impl_->shape->input_size() + static_cast<Index>(impl_->point_of_added.size());
  for (Index v = 0; v < count; ++v) {
    const Index p = impl_->point_of(v);
    s.push_back(impl_->limb_of(p).s()[p]);
  }
  return s;
}

Points Sketch::reference() const { return SketchModel::in_space(impl_->limbs.front(), impl_->curve()); }

Points Sketch::target() const {
  return SketchModel::in_space(impl_->limbs.front(), bent(impl_->curve(), impl_->whole_pose(), impl_->morph));
}

Points Sketch::positions() const { return impl_->of_vertices(impl_->world); }

Points Sketch::rest() const {
  Points points = impl_->world;
  points.leftCols(impl_->shape->points().cols()) = impl_->shape->points();
  if (impl_->refinement) {
    for (std::size_t i = 0; i < impl_->point_of_added.size(); ++i) {
      const auto [a, b] = impl_->refinement->parents[i];
      points.col(impl_->point_of_added[i]) = 0.5 * (points.col(impl_->point_of(a)) + points.col(impl_->point_of(b)));
    }
  }
  return impl_->of_vertices(points);
}

Points Sketch::normals() const { return impl_->of_vertices(point_normals(impl_->world, impl_->triangles())); }

SketchSeed Sketch::seed(double spacing) const {
  const Shape& shape = *impl_->shape;
  const std::vector<Index> labels = this->labels();
  const double reach = std::max(spacing, 1e-9) * shape.diagonal();
  const PointGrid grid(shape.points(), std::max(reach, 1e-300));
  std::vector<bool> taken(shape.points().cols(), false);
  SketchSeed seed;
  for (Index v = 0; v < shape.input_size(); ++v) {
    const Index p = impl_->point_of(v);
    if (labels[v] == kStaticLabel) {
      seed.fixed.push_back(v);
      continue;
    }
    bool wanted = true;
    if (labels[v] == kRegionLabel) {
      grid.for_each_near(shape.points().col(p), [&](Index other, double) {
        if (other != p && taken[other]) wanted = false;
      });
    }
    if (!wanted) continue;
    taken[p] = labels[v] == kRegionLabel;
    seed.vertices.push_back(v);
  }
  seed.targets.resize(3, static_cast<Index>(seed.vertices.size()));
  for (std::size_t i = 0; i < seed.vertices.size(); ++i) {
    seed.targets.col(static_cast<Index>(i)) = impl_->world.col(impl_->point_of(seed.vertices[i]));
  }
  return seed;
}

}  // namespace pliant
