// Editing by strokes: RawSketch of bindings/js/boundary/raw.ts.
#include <memory>
#include <utility>

#include <Eigen/Core>
#include <emscripten/bind.h>

#include "bound_deformation.h"
#include "bound_shape.h"
#include "pliant/sketch/drawing.h"
#include "pliant/sketch/limb_axis.h"
#include "values.h"

namespace pliant::bindings {
namespace {

using emscripten::val;

/// Samples of a stroke or points of a profile, two numbers each.
Polyline to_line(const Scratch& scratch) {
  const std::vector<double>& numbers = scratch.doubles();
  return Eigen::Map<const Polyline>(numbers.data(), 2, static_cast<Index>(numbers.size() / 2));
}

/// Empty until `build` succeeds; the other calls need a sketch. The views it hands out are of its
/// own buffers, valid until the next call.
class BoundSketch final : public BoundDeformation {
 public:
  StatusValue build(const BoundShape& shape, const std::string& names, const Scratch& scratch) {
    return with_camera(names, scratch, [&](const Camera& camera, const Drawing& drawn) {
      auto built = Sketch::create(shape.get(), camera, drawn.reference, drawn.options);
      if (built.ok()) sketch_ = std::move(*built);
      return built.status();
    });
  }
  /// Keeps the stroke along the limb under a pixel, the reference, for the next call; needs no sketch.
  StatusValue find_limb(const BoundShape& shape, const std::string& names, const Scratch& scratch) {
    return with_camera(names, scratch, [&](const Camera& camera, const Drawing& drawn) {
      Result<Stroke> found = stroke_along_limb(*shape.get(), camera, drawn.reference.col(0));
      if (found.ok()) found_limb_ = std::move(*found);
      return found.status();
    });
  }
  val found_limb() const { return view_of(found_limb_); }
  bool held_at_end() const { return sketch_->held_at_end(); }
  StatusValue redraw(const std::string& names, const Scratch& scratch) {
    return with_camera(names, scratch, [this](const Camera& camera, const Drawing& drawn) {
      return sketch_->redraw(camera, drawn.reference);
    });
  }

  StatusValue bend(const Scratch& scratch, bool unfinished) {
    return to_value(sketch_->bend(to_line(scratch), unfinished));
  }
  void unbend() { sketch_->unbend(); }
  StatusValue twist(double radians) { return to_value(sketch_->twist(radians)); }
  StatusValue set_scale(const Scratch& scratch) {
    return with_profile(scratch, [this](const Profile& f) { return sketch_->set_scale(f); });
  }
  StatusValue set_turning(const Scratch& scratch) {
    return with_profile(scratch, [this](const Profile& f) {
      sketch_->set_turning(f);
      return Status();
    });
  }
  StatusValue set_twist_speed(const Scratch& scratch) {
    return with_profile(scratch, [this](const Profile& f) {
      sketch_->set_twist_speed(f);
      return Status();
    });
  }
  void set_smooth(bool smooth) { sketch_->set_smooth(smooth); }
  StatusValue set_morph(double t) { return to_value(sketch_->set_morph(t)); }

  std::string pose(Scratch& scratch) const { return stage(named_pose(sketch_->pose()), scratch); }
  /// A pose, or what lies the part t of the way to another one, whose names begin with "toward/".
  StatusValue set_pose(const std::string& names, const Scratch& scratch, double t) {
    NamedValues given, other;
    for (NamedValue& value : named_values(names, scratch)) {
      const bool toward = value.name.starts_with("toward/");
      if (toward) value.name.erase(0, value.name.find('/') + 1);
      (toward ? other : given).push_back(std::move(value));
    }
    const Result<SketchPose> pose = read_pose(given);
    if (!pose.ok() || other.empty()) return to_value(pose.ok() ? sketch_->set_pose(*pose) : pose.status());
    const Result<SketchPose> toward = read_pose(other);
    if (!toward.ok()) return to_value(toward.status());
    if (pose->turns.size() == toward->turns.size()) {
      return to_value(sketch_->set_pose(SketchPose::blend(*pose, *toward, t)));
    }
    return to_value(
        {ErrorCode::invalid_option, "toward.turns is not as long as pose.turns; expected two poses of this reference"});
  }

  StatusValue refine(const Scratch& scratch, Index max_added) {
    const std::vector<std::int32_t>& ids = scratch.integers();
    return to_value(sketch_->refine({reinterpret_cast<const std::uint32_t*>(ids.data()), ids.size()}, max_added));
  }
  void unrefine() { sketch_->unrefine(); }
  int added() const {
    const Refinement* refinement = sketch_->refinement();
    return refinement ? static_cast<int>(refinement->parents.size()) : -1;
  }
  val parents() {
    ids_.clear();
    for (const auto& [a, b] : sketch_->refinement()->parents) ids_.insert(ids_.end(), {a, b});
    return view_of(ids_);
  }
  val triangles() const { return view_of(sketch_->refinement()->triangles); }
  val triangle_parents() const { return view_of(sketch_->refinement()->triangle_parents); }

  val labels() {
    ids_ = sketch_->labels();
    return view_of(ids_);
  }
  val parameters() {
    parameters_ = sketch_->parameters();
    return view_of(parameters_);
  }
  val reference() { return of_points(sketch_->reference()); }
  val target() { return of_points(sketch_->target()); }
  val rest() { return of_points(sketch_->rest()); }
  /// Keeps a seed for the three calls after it.
  void seed(double spacing) { seed_ = sketch_->seed(spacing); }
  val seed_fixed() const { return view_of(seed_.fixed); }
  val seed_vertices() const { return view_of(seed_.vertices); }
  val seed_targets() const { return view_of(seed_.targets); }

 private:
  Deformation& deformation() override { return *sketch_; }
  template <class Use>
  static StatusValue with_camera(const std::string& names, const Scratch& scratch, const Use& use) {
    return with_fields<Drawing>(names, scratch, [&use](const Drawing& drawn) {
      const Result<Camera> camera = Camera::create(drawn.camera);
      return camera.ok() ? use(*camera, drawn) : camera.status();
    });
  }
  template <class Set>
  StatusValue with_profile(const Scratch& scratch, const Set& set) {
    const Result<Profile> profile = profile_through(to_line(scratch), "profile");
    return to_value(profile.ok() ? set(*profile) : profile.status());
  }
  val of_points(Points points) {
    points_ = std::move(points);
    return view_of(points_);
  }

  std::unique_ptr<Sketch> sketch_;
  SketchSeed seed_;
  std::vector<Index> ids_;
  std::vector<double> parameters_;
  Stroke found_limb_;
  Points points_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(pliant_sketch) {
  emscripten::class_<BoundSketch, emscripten::base<BoundDeformation>>("Sketch")
      .constructor<>()
      .function("build", &BoundSketch::build)
      .function("findLimb", &BoundSketch::find_limb)
      .function("foundLimb", &BoundSketch::found_limb)
      .function("heldAtEnd", &BoundSketch::held_at_end)
      .function("redraw", &BoundSketch::redraw)
      .function("bend", &BoundSketch::bend)
      .function("unbend", &BoundSketch::unbend)
      .function("twist", &BoundSketch::twist)
      .function("setScale", &BoundSketch::set_scale)
      .function("setTurning", &BoundSketch::set_turning)
      .function("setTwistSpeed", &BoundSketch::set_twist_speed)
      .function("setSmooth", &BoundSketch::set_smooth)
      .function("setMorph", &BoundSketch::set_morph)
      .function("pose", &BoundSketch::pose)
      .function("setPose", &BoundSketch::set_pose)
      .function("refine", &BoundSketch::refine)
      .function("unrefine", &BoundSketch::unrefine)
      .function("added", &BoundSketch::added)
      .function("parents", &BoundSketch::parents)
      .function("triangles", &BoundSketch::triangles)
      .function("triangleParents", &BoundSketch::triangle_parents)
      .function("labels", &BoundSketch::labels)
      .function("parameters", &BoundSketch::parameters)
      .function("reference", &BoundSketch::reference)
      .function("target", &BoundSketch::target)
      .function("rest", &BoundSketch::rest)
      .function("seed", &BoundSketch::seed)
      .function("seedFixed", &BoundSketch::seed_fixed)
      .function("seedVertices", &BoundSketch::seed_vertices)
      .function("seedTargets", &BoundSketch::seed_targets);
}

}  // namespace pliant::bindings
