#include "pliant/sketch/sketch.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/sketch/sketch_impl.h"

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

/// Filtered pixels, from the held end on.
Polyline from_held_end(const Polyline& drawn, bool held_at_end) {
  return held_at_end ? Polyline(drawn.rowwise().reverse()) : drawn;
}

/// Whether a filtered stroke, as drawn, is held at its end. `given`: the region, if it is not to be
/// chosen.
Result<bool> find_held_end(const SeenShape& seen, const Polyline& drawn, Hold hold, const Region* given) {
  if (hold != Hold::larger) return hold == Hold::end;
  const Result<LaidStroke> laid = lay_stroke(seen, drawn);
  if (!laid.ok()) return laid.status();
  return given ? runs_to_static(seen, laid->curve, *given) : more_beyond_end(seen, *laid);
}

/// A filtered stroke on a shape seen through a camera, with a region given.
Result<Limb> limb_over(SeenShape seen, const Polyline& pixels, Region region) {
  Result<LaidStroke> laid = lay_stroke(seen, pixels);
  if (!laid.ok()) return laid.status();
  return Limb(std::move(seen), std::move(*laid), std::move(region));
}

/// The same with a region chosen. What of the stroke lies before the region is dropped, and
/// `start` says how much; a start already found is kept.
Result<Limb> limb_under(SeenShape seen, const Polyline& pixels, std::span<const Polyline> partitions, bool mirrored,
                        double& start) {
  Result<LaidStroke> laid = lay_stroke(seen, without_start(pixels, start));
  if (!laid.ok()) return laid.status();
  Result<Region> region = choose_region(seen, *laid, partitions);
  if (!region.ok()) return region.status();
  if (mirrored || region->start == 0.0) {
    return Limb(std::move(seen), std::move(*laid), std::move(*region));
  }
  start = region->start;
  return limb_over(std::move(seen), without_start(pixels, start), std::move(*region));
}

Status check_apart(const Region& a, const Region& b) {
  for (std::size_t p = 0; p < a.of_point.size(); ++p) {
    if (a.of_point[p] != kStaticLabel && b.of_point[p] != kStaticLabel) {
      return invalid("mirror reflects the region onto itself; expected a limb on one side of it");
    }
  }
  return {};
}

/// What of the reference an unfinished target has not reached yet, turned to go on from its end.
Stroke continued(const Stroke& target, const Polyline& reference) {
  const double drawn = length_of(target), whole = length_of(reference);
  const Index last = static_cast<Index>(reference.cols()) - 1;
  const Index from = static_cast<Index>(std::ceil(drawn / whole * last));
  if (from >= last) return target;
  // The direction of the last few pixels: single samples are too noisy.
  Index before = static_cast<Index>(target.cols()) - 1;
  const Eigen::Vector2d end = target.col(before);
  while (before > 0 && (end - target.col(before)).norm() < 2 * kMinStrokeSegment) --before;
  const Eigen::Vector2d u = reference.col(from + 1) - reference.col(from);
  const Eigen::Vector2d v = end - target.col(before);
  const double angle = std::atan2(v.y(), v.x()) - std::atan2(u.y(), u.x());
  const Eigen::Rotation2D<double> turn(angle);
  const Eigen::Index kept = target.cols();
  Stroke result(2, kept + last - from);
  result.leftCols(kept) = target;
  for (Index i = from + 1; i <= last; ++i) {
    result.col(kept + i - from - 1) = end + turn * (reference.col(i) - reference.col(from));
  }
  return result;
}

}  // namespace

// -- What it holds.

SketchPose SketchImpl::whole_pose() const {
  SketchPose pose = base;
  if (turning == Profile::identity()) return pose;
  const double step = 1.0 / static_cast<double>(curve().size() - 1);
  for (std::size_t i = 0; i < pose.turns.size(); ++i) {
    const double s = step * static_cast<double>(i + 1);
    pose.turns[i] += (turning(s) - s) * step;  // eq. 8, whatever the number of nodes
  }
  return pose;
}

void SketchImpl::pose_changed(bool preview) {
  const SketchPose pose = whole_pose();
  for (Limb& limb : limbs) limb.set_pose(pose, preview ? 1e-4 : 1e-8);
  show();
}

void SketchImpl::show() {
  const Index points = static_cast<Index>(shape->points().cols());
  world.leftCols(points) = shape->points();
  if (refinement) {
    for (std::size_t i = 0; i < refinement->parents.size(); ++i) {
      const auto [a, b] = refinement->parents[i];
      const Index p = point_of_added[i];
      world.col(p) = 0.5 * (world.col(point_of(a)) + world.col(point_of(b)));
    }
  }
  for (const Limb& limb : limbs) limb.show(morph, world);
}

Status SketchImpl::find_joints() {
  for (Limb& limb : limbs) {
    if (Status status = limb.find_joints(); !status.ok()) return status;
  }
  return {};
}

// -- Choosing.

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
  Region given;
  if (!options.labels.empty()) {
    Result<std::vector<Index>> labels = point_labels(*shape, options.labels);
    if (!labels.ok()) return labels.status();
    given = region_from_labels(shape->triangles(), *labels);
  }
  const Result<bool> held_at_end = find_held_end(seen_through(camera, *shape), impl->reference_pixels, options.hold,
                                                 options.labels.empty() ? nullptr : &given);
  if (!held_at_end.ok()) return held_at_end.status();
  impl->held_at_end = *held_at_end;
  const Polyline pixels = from_held_end(impl->reference_pixels, *held_at_end);
  for (const bool mirrored : {false, true}) {
    if (mirrored && !options.mirror) break;
    SeenShape seen = seen_through(mirrored ? camera.mirrored(*options.mirror) : camera, *shape);
    Result<Limb> limb = options.labels.empty()
                            ? limb_under(std::move(seen), pixels, options.partitions, mirrored, impl->start)
                            : limb_over(std::move(seen), pixels, given);
    if (!limb.ok()) return limb.status();
    impl->limbs.push_back(std::move(*limb));
  }
  if (options.mirror) {
    if (Status status = check_apart(impl->limbs[0].region(), impl->limbs[1].region()); !status.ok()) {
      return status;
    }
  }
  impl->base = SketchPose::rest(impl->curve());
  for (Limb& limb : impl->limbs) limb.set_smooth(options.smooth);
  impl->world = shape->points();
  return std::unique_ptr<Sketch>(new Sketch(std::move(impl)));
}

Status Sketch::redraw(const Camera& camera, const Stroke& reference) {
  if (Status status = check_stroke(reference, "reference"); !status.ok()) return status;
  const Polyline drawn = filtered(reference, nodes_for(reference));
  const Result<bool> held_at_end =
      find_held_end(seen_through(camera, *impl_->shape), drawn, impl_->hold, &impl_->limbs.front().region());
  if (!held_at_end.ok()) return held_at_end.status();
  const Polyline pixels = from_held_end(drawn, *held_at_end);
  std::vector<Limb> limbs;
  for (std::size_t k = 0; k < impl_->limbs.size(); ++k) {
    Result<Limb> limb = limb_over(seen_through(k == 0 ? camera : camera.mirrored(*impl_->mirror), *impl_->shape),
                                  pixels, impl_->limbs[k].region());
    if (!limb.ok()) return limb.status();
    limbs.push_back(std::move(*limb));
  }
  unrefine();
  impl_->limbs = std::move(limbs);
  impl_->reference_pixels = drawn;
  impl_->held_at_end = *held_at_end;
  impl_->start = 0.0;
  for (Limb& limb : impl_->limbs) limb.set_smooth(impl_->smooth);
  reset();
  return {};
}

bool Sketch::held_at_end() const { return impl_->held_at_end; }

// -- Posing.

Status Sketch::bend(const Stroke& target, bool unfinished) {
  if (Status status = check_stroke(target, "target"); !status.ok()) return status;
  const PlaneCurve& reference = impl_->curve();
  const Stroke whole = unfinished ? continued(target, impl_->reference_pixels) : target;
  const Polyline pixels = from_held_end(filtered(whole, reference.size()), impl_->held_at_end);
  Polyline nodes = without_start(pixels, impl_->start);
  for (auto node : nodes.colwise()) {
    node = impl_->limbs.front().camera().at_depth(node, impl_->limbs.front().depth());
  }
  const PlaneCurve curve(std::move(nodes));
  SketchPose& pose = impl_->base;
  pose.heading = angle_between(curve.heading(), reference.heading());
  pose.length = curve.step() / reference.step();
  for (std::size_t i = 0; i < pose.turns.size(); ++i) {
    pose.turns[i] = curve.turns()[i] - reference.turns()[i];
  }
  impl_->pose_changed(unfinished);
  return {};
}

void Sketch::unbend() {
  SketchPose& pose = impl_->base;
  pose.heading = 0.0;
  pose.length = 1.0;
  std::fill(pose.turns.begin(), pose.turns.end(), 0.0);
  impl_->pose_changed();
}

Status Sketch::twist(double radians) {
  if (!std::isfinite(radians)) return invalid("twist is not finite; expected an angle");
  if (radians != 0.0) {
    if (Status status = impl_->find_joints(); !status.ok()) return status;
  }
  impl_->twist_angle = radians;
  impl_->base.twist = radians == 0.0 ? Profile::constant(0.0) : impl_->twist_speed.times(radians);
  impl_->pose_changed();
  return {};
}

namespace {

Status check_scale(const Profile& factor) {
  for (const auto& [s, f] : factor.points()) {
    if (f > 0.0) continue;
    return invalid(message({"scale is ", f, " at s = ", s, "; expected factors above 0"}));
  }
  return {};
}

}  // namespace

Status Sketch::set_scale(const Profile& factor) {
  if (Status status = check_scale(factor); !status.ok()) return status;
  if (Status status = impl_->find_joints(); !status.ok()) return status;
  impl_->base.scale = factor;
  impl_->pose_changed();
  return {};
}

void Sketch::set_turning(const Profile& offset) {
  impl_->turning = offset;
  impl_->pose_changed();
}

void Sketch::set_twist_speed(const Profile& speed) {
  impl_->twist_speed = speed;
  if (impl_->twist_angle == 0.0) return;
  impl_->base.twist = speed.times(impl_->twist_angle);
  impl_->pose_changed();
}

bool Sketch::smooth() const { return impl_->smooth; }

void Sketch::set_smooth(bool smooth) {
  impl_->smooth = smooth;
  for (Limb& limb : impl_->limbs) limb.set_smooth(smooth);
  impl_->pose_changed();
}

Status Sketch::set_morph(double t) {
  if (!(t >= 0.0 && t <= 1.0)) {
    return invalid(message({"morph is ", t, "; expected a number from 0 to 1"}));
  }
  impl_->morph = t;
  impl_->show();
  return {};
}

void Sketch::reset() {
  impl_->base = SketchPose::rest(impl_->curve());
  impl_->turning = impl_->twist_speed = Profile::identity();
  impl_->twist_angle = 0.0;
  impl_->morph = 1.0;
  impl_->pose_changed();
}

SketchPose Sketch::pose() const { return impl_->whole_pose(); }

Status Sketch::set_pose(const SketchPose& pose) {
  if (pose.turns.size() != impl_->base.turns.size()) {
    return invalid(message({"pose.turns has length ", pose.turns.size(), "; expected ", impl_->base.turns.size(),
                            ", those of this reference"}));
  }
  const bool finite =
      std::isfinite(pose.heading) && std::isfinite(pose.length) &&
      std::all_of(pose.turns.begin(), pose.turns.end(), [](double turn) { return std::isfinite(turn); });
  if (!finite || !(pose.length > 0.0)) {
    return invalid("pose has a number that is not finite or no length; expected those of pose()");
  }
  if (Status status = check_scale(pose.scale); !status.ok()) return status;
  if (pose.twists() || pose.scales()) {
    if (Status status = impl_->find_joints(); !status.ok()) return status;
  }
  impl_->base = pose;
  impl_->turning = impl_->twist_speed = Profile::identity();
  impl_->twist_angle = 0.0;
  impl_->pose_changed();
  return {};
}

}  // namespace pliant
