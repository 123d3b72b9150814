// As-rigid-as-possible deformation (Sorkine & Alexa: As-Rigid-As-Possible Surface Modeling, SGP
// 2007): every point has a rotation, edges should be turned and nothing else.
#pragma once

#include <memory>

#include "pliant/deformers/arap/options.h"
#include "pliant/solve/local_global_deformer.h"

namespace pliant {

/// Surfaces in space, or flat ones in the plane (Shape::dimension 2: rotations stay in it). Deforms
/// the surface, not space: transform_points is not_solvable.
class Arap final : public LocalGlobalDeformer {
 public:
  /// Errors: invalid_option; invalid_shape (no triangles).
  static Result<std::unique_ptr<Arap>> create(std::shared_ptr<const Shape> shape, const ArapOptions& options);
  ~Arap() override;

  /// Replaces the options of a living deformer; handles, targets and the deformation stay, the next
  /// step goes on from there. Cost at that step: `energy` or another `constraint_weight` or
  /// `smoothness` above 0: one factorisation; soft against exact handles, or `smoothness` switched
  /// on or off: an analysis and one factorisation. Errors: invalid_option; then nothing changes.
  Status set_options(const ArapOptions& options);
  Status set_options(const NamedValues& given) override;
  const ArapOptions& options() const;
  NamedValues options_by_name() const override;

  /// Terms: `rigidity`, with a smoothness above 0 `smoothness`, with soft handles `constraint`.
  Energy energy() const override;
  /// edges[]/i, j, weight (the weight of the spokes; with rims the sum of both half
  /// cotangents), rotations, result; handles.
  State do_save() const override;

 private:
  LocalModel& model() const override;
  struct Impl;
  Arap(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant
