// Editing by two strokes: a reference over a limb, then where it should go. Kho and Garland,
// "Sketching Mesh Deformations", I3D 2005; equation numbers are the paper's.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/curves/profile.h"
#include "pliant/geometry/shape.h"
#include "pliant/sketch/camera.h"
#include "pliant/sketch/pose.h"
#include "pliant/sketch/refinement.h"
#include "pliant/sketch/region.h"
#include "pliant/sketch/stroke.h"
#include "pliant/solve/deformation.h"

namespace pliant {

struct SketchOptions {
  /// Lines across the shape; what each cuts off the region becomes a rigid part (section 4.2.1).
  /// Only the first and the last sample of each count.
  std::vector<Stroke> partitions;
  bool smooth = true;  ///< eq. 9 on the parameters
  /// Which end of the reference stroke is held; the other moves. With labels the larger side is the
  /// static one.
  Hold hold = Hold::larger;
  std::optional<Plane> mirror;  ///< the same gesture on the limb mirrored in this plane, too
  /// A label a vertex of the input, as `Sketch::labels` gives them: the region is taken over, not
  /// chosen. Empty: it is chosen. Not together with partitions or mirror.
  std::vector<Index> labels;
};

/// Handles for any solver that should finish what the sketch began.
struct SketchSeed {
  std::vector<Index> fixed;     ///< vertices of the static part, ascending
  std::vector<Index> vertices;  ///< rigid parts and spread samples of the region, ascending
  Points targets;               ///< 3 x |vertices|
};

/// A shape, a region chosen by a stroke, and its pose. Choosing (create, redraw) analyses the
/// region once; every call that poses costs one solve with what was prepared and one pass over the
/// region, and allocates little: cheap enough for every event of a pen. `reset` keeps the region and
/// smooth.
class Sketch final : public Deformation {
 public:
  /// Filters the reference stroke, lays it on the plane through the first hit, finds the region and
  /// skins it. The pose is rest. One end of the stroke is held, the other is moved
  /// (`SketchOptions::hold`); s runs from the held end (0) to the other (1).
  /// Errors: invalid_shape (no triangles); invalid_option (a stroke that is too short or not
  /// finite, shape behind the camera, a stroke that covers nothing or leaves the shape at once, a
  /// partition that cuts nothing off, mirrored regions that overlap, labels that do not fit).
  static Result<std::unique_ptr<Sketch>> create(std::shared_ptr<const Shape> shape, const Camera& camera,
                                                const Stroke& reference, const SketchOptions& options = {});
  ~Sketch() override;

  /// Another reference stroke over the same region, maybe seen from elsewhere; the pose is rest.
  /// Errors: those of create; nothing changes then.
  Status redraw(const Camera& camera, const Stroke& reference);

  /// Whether the reference is held at its end, not at its start.
  bool held_at_end() const;

  // -- Posing: bend, twist and scale add up; each call replaces what it set before.
  /// The target stroke (eq. 1-6), drawn as the reference was, and moved so that the held ends of both
  /// are one. May be called
  /// with each sample while it is drawn: `unfinished` then continues it by what is left of the
  /// reference, so that the limb keeps its length. Errors: invalid_option.
  Status bend(const Stroke& target, bool unfinished = false);
  /// Takes the bend back; twist and scale stay.
  void unbend();
  /// Right-handed about the stroke's direction, radians between its ends, any size (eq. 7).
  /// Errors: invalid_option (not finite; a node of the reference that meets the shape less than
  /// twice).
  Status twist(double radians);
  /// F(s) on the offsets from the joints, above 0 (section 5.3). Errors as twist.
  Status set_scale(const Profile& factor);
  /// F(s) in eq. 8: turns the target by F(s) - s radians a unit of s. identity(): as drawn.
  void set_turning(const Profile& offset);
  /// F(s) on the twist's angle. identity(): evenly.
  void set_twist_speed(const Profile& speed);
  /// Eq. 9 on or off; the pose stays.
  void set_smooth(bool smooth);
  bool smooth() const;
  /// Shows the way from rest (0) to the pose (1), section 6.1. Errors: invalid_option (outside).
  Status set_morph(double t);
  void reset() override;

  /// The pose without morph, and back: key poses. Spline controls are contained, and return to
  /// identity. Errors: invalid_option (another number of turns, not finite, scale not above 0;
  /// twist or scale where there are no joints).
  SketchPose pose() const;
  Status set_pose(const SketchPose& pose);

  // -- Refinement (section 5.5), for the pose as it is.
  /// Splits edges that are stretched by more than 1.5 and bent by more than pi / 24, and again, down
  /// to the length of a step of the reference curve (5 pixels, or a 60th of it).
  /// triangles: those of the input, 3 x m ids. Replaces an earlier refinement; later poses move the
  /// added vertices too. Errors: invalid_shape (ids), too_large (beyond max_added).
  Status refine(std::span<const std::uint32_t> triangles, Index max_added = 1'000'000);
  void unrefine();
  /// nullptr without one.
  const Refinement* refinement() const;

  // -- Results.
  /// 0 static, 1 region, 2.. rigid parts; one a vertex of the input.
  std::vector<Index> labels() const;
  /// Normalised arc length of every vertex: as skinned, or smoothed; that of its virtual vertex in
  /// a rigid part, 0 in the static one.
  std::vector<double> parameters() const;
  /// Curves in space, 3 x nodes; the target's at the current morph.
  Points reference() const;
  Points target() const;
  Points positions() const override;
  Points normals() const override;
  /// 3 x (n + added) positions at rest.
  Points rest() const;
  /// Targets for another solver: rigid parts whole, of the region vertices no closer to one another
  /// than `spacing` diagonals (at least 0).
  SketchSeed seed(double spacing = 0.05) const;
  /// The tables of docs/state-and-report.md; see sketch/state.cpp for those beside them.
  State save() const override;
  /// Needs `pose` and `morph`, over the `labels` and the `reference` of this sketch; spline controls
  /// are in the pose, as set_pose has it. Vertices that a refinement added have to be those of now;
  /// a state without any takes them back.
  Status restore(const State& state) override;

 private:
  friend struct SketchModel;
  using Impl = struct SketchModel;
  explicit Sketch(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant
