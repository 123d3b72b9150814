// How a Sketch comes to its limbs: choosing, and drawing the reference anew.
#include <algorithm>
#include <string>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/sketch/sketch_model.h"

namespace pliant {
namespace {

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

SeenShape seen_through(const Camera& camera, const Shape& shape) {
  SeenShape seen{camera, Points(3, shape.points().cols()), shape.triangles()};
  for (Index p = 0; p < seen.view.cols(); ++p) {
    seen.view.col(p) = camera.to_view(shape.points().col(p));
  }
  return seen;
}

Status check_options(const Shape& shape, const SketchOptions& options) {
  for (std::size_t i = 0; i < options.partitions.size(); ++i) {
    const std::string name = message({"partitions[", i, "]"});
    if (Status status = check_stroke(options.partitions[i], name.c_str()); !status.ok()) {
      return status;
    }
  }
  if (options.mirror) {
    const Plane& plane = *options.mirror;
    if (!plane.point.allFinite() || !plane.normal.allFinite() || !(plane.normal.stableNorm() > 0.0)) {
      return invalid("mirror is not a plane; expected a finite point and a finite normal not zero");
    }
  }
  if (options.labels.empty()) return {};
  if (options.mirror || !options.partitions.empty()) {
    return invalid("labels are given with partitions or mirror; expected one or the other");
  }
  if (static_cast<Index>(options.labels.size()) != shape.input_size()) {
    return invalid(
        message({"labels has length ", options.labels.size(), "; expected ", shape.input_size(), ", one a vertex"}));
  }
  return {};
}

/// Labels of the points; every rigid number below the largest must occur.
Result<std::vector<Index>> point_labels(const Shape& shape, const std::vector<Index>& labels) {
  std::vector<Index> of_point(shape.points().cols());
  std::vector<bool> used(shape.points().cols() + 2, false);
  for (Index v = 0; v < shape.input_size(); ++v) {
    const Index point = shape.point_of_vertex()[v];
    const Index first = labels[shape.vertex_of_point()[point]];
    if (labels[v] < 0 || labels[v] >= static_cast<Index>(used.size())) {
      return invalid(message({"labels[", v, "] is ", labels[v], "; expected 0, 1 or a rigid part from 2 on"}));
    }
    if (labels[v] != first) {
      return invalid(message(
          {"labels[", v, "] is ", labels[v], "; expected ", first, " as that of the vertex at the same position"}));
    }
    of_point[point] = labels[v];
    used[labels[v]] = true;
  }
  const auto last = std::find(used.rbegin(), used.rend(), true).base();
  const auto gap = std::find(used.begin() + 1, last, false);
  if (!used[kRegionLabel] || gap != last) {
    const auto missing = used[kRegionLabel] ? gap - used.begin() : kRegionLabel;
    return invalid(message({"labels has no vertex with label ", missing,
                            "; expected a region (1) and rigid parts numbered without gaps"}));
  }
  if (const auto torn = torn_edge(shape.triangles(), of_point)) {
    const auto [a, b] = *torn;
    const auto& vertex = shape.vertex_of_point();
    return invalid(message({"labels[", vertex[a], "] is ", of_point[a], " beside labels[", vertex[b], "], ",
                            of_point[b], "; expected vertices of the region (1) between"}));
  }
  return of_point;
}

/// A limb with its stroke laid from the held end on.
struct Chosen {
  Limb limb;
  bool held_at_end;    ///< of the stroke as drawn
  double start = 0.0;  ///< fraction of the stroke, from the held end, before the region
};

Result<LaidStroke> from_held_end(const SeenShape& seen, LaidStroke drawn, bool held_at_end) {
  return held_at_end ? reversed(seen, std::move(drawn)) : Result<LaidStroke>(std::move(drawn));
}

/// A filtered stroke from the held end on, on a shape seen through a camera, with a region given.
Result<Limb> limb_over(SeenShape&& seen, const Polyline& pixels, Region region) {
  Result<LaidStroke> laid = lay_stroke(seen, pixels);
  if (!laid.ok()) return laid.status();
  return Limb(std::move(seen), std::move(*laid), std::move(region));
}

/// The same for a stroke as drawn.
Result<Chosen> choose_over(SeenShape&& seen, const Polyline& drawn, Hold hold, Region region) {
  Result<LaidStroke> laid = lay_stroke(seen, drawn);
  if (!laid.ok()) return laid.status();
  const bool at_end = hold == Hold::larger ? runs_to_static(seen, laid->curve, region) : hold == Hold::end;
  Result<LaidStroke> held = from_held_end(seen, std::move(*laid), at_end);
  if (!held.ok()) return held.status();
  return Chosen{Limb(std::move(seen), std::move(*held), std::move(region)), at_end};
}

/// The same with a region chosen. What of the stroke lies before it is dropped.
Result<Chosen> choose_under(SeenShape&& seen, const Polyline& drawn, Hold hold, std::span<const Polyline> partitions) {
  Result<LaidStroke> laid = lay_stroke(seen, drawn);
  if (!laid.ok()) return laid.status();
  const std::vector<Index> component = component_under(seen, *laid);
  const bool at_end = hold == Hold::larger ? more_beyond_end(seen, *laid, component) : hold == Hold::end;
  Result<LaidStroke> held = from_held_end(seen, std::move(*laid), at_end);
  if (!held.ok()) return held.status();
  Result<Region> region = choose_region(seen, *held, component, partitions);
  if (!region.ok()) return region.status();
  const double start = region->start;
  if (start == 0.0) return Chosen{Limb(std::move(seen), std::move(*held), std::move(*region)), at_end};
  Result<Limb> limb = limb_over(std::move(seen), without_start(held->pixels, start), std::move(*region));
  if (!limb.ok()) return limb.status();
  return Chosen{std::move(*limb), at_end, start};
}

/// The limb in the mirror, whose stroke is known to be `pixels` from the held end on.
Result<Limb> mirrored_limb_under(SeenShape&& seen, const Polyline& pixels, std::span<const Polyline> partitions) {
  Result<LaidStroke> laid = lay_stroke(seen, pixels);
  if (!laid.ok()) return laid.status();
  Result<Region> region = choose_region(seen, *laid, component_under(seen, *laid), partitions);
  if (!region.ok()) return region.status();
  return Limb(std::move(seen), std::move(*laid), std::move(*region));
}

Status check_apart(const Region& a, const Region& b) {
  for (std::size_t p = 0; p < a.of_point.size(); ++p) {
    if (a.of_point[p] != kStaticLabel && b.of_point[p] != kStaticLabel) {
      return invalid("mirror reflects the region onto itself; expected a limb on one side of it");
    }
  }
  return {};
}

}  // namespace

Sketch::Sketch(std::unique_ptr<Impl> impl) : Deformation(impl->shape), impl_(std::move(impl)) {}
Sketch::~Sketch() = default;

Result<std::unique_ptr<Sketch>> Sketch::create(std::shared_ptr<const Shape> shape, const Camera& camera,
                                               const Stroke& reference, const SketchOptions& options) {
  if (shape->triangles().cols() == 0) {
    return Status(ErrorCode::invalid_shape, "the shape has no triangles; expected a mesh to sketch on");
  }
  if (Status status = check_stroke(reference, "reference"); !status.ok()) return status;
  if (Status status = check_options(*shape, options); !status.ok()) return status;

  auto impl = std::make_unique<Impl>();
  impl->shape = shape;
  impl->mirror = options.mirror;
  impl->smooth = options.smooth;
  impl->hold = options.hold;
  impl->reference_pixels = filtered(reference, nodes_for(reference));
  const Result<std::vector<Index>> labels =
      options.labels.empty() ? std::vector<Index>() : point_labels(*shape, options.labels);
  if (!labels.ok()) return labels.status();
  SeenShape seen = seen_through(camera, *shape);
  Result<Chosen> chosen = options.labels.empty()
                              ? choose_under(std::move(seen), impl->reference_pixels, options.hold, options.partitions)
                              : choose_over(std::move(seen), impl->reference_pixels, options.hold,
                                            region_from_labels(shape->triangles(), *labels));
  if (!chosen.ok()) return chosen.status();
  impl->held_at_end = chosen->held_at_end;
  impl->start = chosen->start;
  impl->limbs.push_back(std::move(chosen->limb));
  if (options.mirror) {
    const Polyline pixels = without_start(from_held_end(impl->reference_pixels, impl->held_at_end), impl->start);
    Result<Limb> limb =
        mirrored_limb_under(seen_through(camera.mirrored(*options.mirror), *shape), pixels, options.partitions);
    if (!limb.ok()) return limb.status();
    impl->limbs.push_back(std::move(*limb));
    if (Status status = check_apart(impl->limbs[0].region(), impl->limbs[1].region()); !status.ok()) return status;
  }
  impl->base = SketchPose::rest(impl->curve());
  for (Limb& limb : impl->limbs) limb.set_smooth(options.smooth);
  impl->world = shape->points();
  return std::unique_ptr<Sketch>(new Sketch(std::move(impl)));
}

Status Sketch::redraw(const Camera& camera, const Stroke& reference) {
  if (Status status = check_stroke(reference, "reference"); !status.ok()) return status;
  const Polyline drawn = filtered(reference, nodes_for(reference));
  Result<Chosen> chosen =
      choose_over(seen_through(camera, *impl_->shape), drawn, impl_->hold, impl_->limbs.front().region());
  if (!chosen.ok()) return chosen.status();
  std::vector<Limb> limbs;
  limbs.push_back(std::move(chosen->limb));
  if (impl_->mirror) {
    Result<Limb> limb = limb_over(seen_through(camera.mirrored(*impl_->mirror), *impl_->shape),
                                  from_held_end(drawn, chosen->held_at_end), impl_->limbs[1].region());
    if (!limb.ok()) return limb.status();
    limbs.push_back(std::move(*limb));
  }
  unrefine();
  impl_->limbs = std::move(limbs);
  impl_->reference_pixels = drawn;
  impl_->held_at_end = chosen->held_at_end;
  impl_->start = 0.0;
  for (Limb& limb : impl_->limbs) limb.set_smooth(impl_->smooth);
  reset();
  return {};
}

bool Sketch::held_at_end() const { return impl_->held_at_end; }

}  // namespace pliant
