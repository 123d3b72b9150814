// Editing by strokes: RawSketch of bindings/js/boundary/raw.ts.
#include <memory>
#include <span>
#include <utility>

#include <Eigen/Core>
#include <emscripten/bind.h>

#include "bound_deformation.h"
#include "bound_shape.h"
#include "pliant/sketch/limb_axis.h"
#include "pliant/sketch/sketch.h"

namespace pliant::bindings {
namespace {

using emscripten::val;

/// Takes what JavaScript packed into a scratch, front to back.
class Unpacker {
 public:
  explicit Unpacker(const Scratch& scratch) : doubles_(scratch.doubles()), integers_(scratch.integers()) {}

  double number() { return numbers(1).front(); }
  Eigen::Vector3d vector() {
    const std::span<const double> xyz = numbers(3);
    return {xyz[0], xyz[1], xyz[2]};
  }
  /// The number of samples is among the integers.
  Stroke stroke() {
    const Index samples = integers(1).front();
    return Eigen::Map<const Stroke>(numbers(2 * samples).data(), 2, samples);
  }
  /// So is the number of points.
  std::vector<Profile::Point> points() {
    const Stroke pairs = stroke();
    std::vector<Profile::Point> points;
    for (const auto& pair : pairs.colwise()) points.emplace_back(pair.x(), pair.y());
    return points;
  }
  CameraOptions camera() {
    CameraOptions camera;
    camera.eye = vector();
    camera.target = vector();
    camera.up = vector();
    const bool orthographic = integers(1).front() != 0;
    const double extent = number();
    if (orthographic) {
      camera.orthographic_height = extent;
    } else {
      camera.fov_y = extent;
    }
    camera.width = number();
    camera.height = number();
    return camera;
  }
  Result<SketchPose> pose() {
    SketchPose pose;
    pose.heading = number();
    pose.length = number();
    const std::span<const double> turns = numbers(integers(1).front());
    pose.turns.assign(turns.begin(), turns.end());
    Result<Profile> twist = Profile::create(points(), "pose.twist");
    if (!twist.ok()) return twist.status();
    Result<Profile> scale = Profile::create(points(), "pose.scale");
    if (!scale.ok()) return scale.status();
    pose.twist = std::move(*twist);
    pose.scale = std::move(*scale);
    return pose;
  }
  std::span<const std::int32_t> integers(std::size_t count) {
    next_integer_ += count;
    return integers_.subspan(next_integer_ - count, count);
  }
  std::span<const std::int32_t> rest() { return integers_.subspan(next_integer_); }

 private:
  std::span<const double> numbers(std::size_t count) {
    next_double_ += count;
    return doubles_.subspan(next_double_ - count, count);
  }

  std::span<const double> doubles_;
  std::span<const std::int32_t> integers_;
  std::size_t next_double_ = 0, next_integer_ = 0;
};

/// Empty until `build` succeeds; the other calls need a sketch. The views it hands out are of its
/// own buffers, valid until the next call.
class BoundSketch final : public BoundDeformation {
 public:
  StatusValue build(const BoundShape& shape, bool smooth, bool mirrored, int hold, const Scratch& scratch) {
    Unpacker from(scratch);
    const Result<Camera> camera = Camera::create(from.camera());
    if (!camera.ok()) return to_value(camera.status());
    const Stroke reference = from.stroke();
    SketchOptions options;
    options.smooth = smooth;
    options.hold = static_cast<Hold>(hold);
    if (mirrored) {
      Plane& plane = options.mirror.emplace();
      plane.point = from.vector();
      plane.normal = from.vector();
    }
    const int partitions = from.integers(1).front();
    for (int i = 0; i < partitions; ++i) options.partitions.push_back(from.stroke());
    const auto labels = from.rest();
    options.labels.assign(labels.begin(), labels.end());
    auto built = Sketch::create(shape.get(), *camera, reference, options);
    if (built.ok()) sketch_ = std::move(*built);
    return to_value(built.status());
  }
  /// Keeps the stroke along the limb under a pixel for the next call; needs no sketch.
  StatusValue find_limb(const BoundShape& shape, const Scratch& scratch) {
    Unpacker from(scratch);
    const Result<Camera> camera = Camera::create(from.camera());
    if (!camera.ok()) return to_value(camera.status());
    const Result<Stroke> found = stroke_along_limb(*shape.get(), *camera, from.stroke().col(0));
    if (found.ok()) numbers_.assign(found->data(), found->data() + found->size());
    return to_value(found.status());
  }
  val found_limb() const { return view_of(numbers_); }
  bool held_at_end() const { return sketch_->held_at_end(); }
  StatusValue redraw(const Scratch& scratch) {
    Unpacker from(scratch);
    const Result<Camera> camera = Camera::create(from.camera());
    if (!camera.ok()) return to_value(camera.status());
    return to_value(sketch_->redraw(*camera, from.stroke()));
  }

  StatusValue bend(const Scratch& scratch, bool unfinished) {
    return to_value(sketch_->bend(Unpacker(scratch).stroke(), unfinished));
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

  /// Packed as `Unpacker::pose` takes it, with the counts in line.
  val pose() {
    const SketchPose pose = sketch_->pose();
    numbers_ = {pose.heading, pose.length, static_cast<double>(pose.turns.size())};
    numbers_.insert(numbers_.end(), pose.turns.begin(), pose.turns.end());
    for (const Profile* profile : {&pose.twist, &pose.scale}) {
      numbers_.push_back(static_cast<double>(profile->points().size()));
      for (const auto& [s, f] : profile->points()) numbers_.insert(numbers_.end(), {s, f});
    }
    return view_of(numbers_);
  }
  /// A pose; two: the share t of the way from the first to the second.
  StatusValue set_pose(const Scratch& scratch, bool two, double t) {
    Unpacker from(scratch);
    const Result<SketchPose> pose = from.pose();
    if (!pose.ok() || !two) {
      return to_value(pose.ok() ? sketch_->set_pose(*pose) : pose.status());
    }
    const Result<SketchPose> toward = from.pose();
    if (!toward.ok()) return to_value(toward.status());
    if (pose->turns.size() != toward->turns.size()) {
      return to_value({ErrorCode::invalid_option,
                       "toward.turns is not as long as pose.turns; "
                       "expected two poses of this reference"});
    }
    return to_value(sketch_->set_pose(SketchPose::blend(*pose, *toward, t)));
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
    numbers_ = sketch_->parameters();
    return view_of(numbers_);
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
  template <class Set>
  StatusValue with_profile(const Scratch& scratch, const Set& set) {
    const Result<Profile> profile = Profile::create(Unpacker(scratch).points(), "profile");
    return to_value(profile.ok() ? set(*profile) : profile.status());
  }
  val of_points(Points points) {
    points_ = std::move(points);
    return view_of(points_);
  }

  std::unique_ptr<Sketch> sketch_;
  SketchSeed seed_;
  std::vector<Index> ids_;
  std::vector<double> numbers_;
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
