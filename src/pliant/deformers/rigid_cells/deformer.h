// Rigid cells (Botsch, Pauly, Wicke, Gross: Adaptive Space Deformations Based on Rigid Cells,
// Eurographics 2007): the space a shape fills, in boxes that stay rigid and are glued elastically.
#pragma once

#include <memory>

#include "pliant/deformers/rigid_cells/options.h"
#include "pliant/solve/deformer.h"

namespace pliant {

class RigidCells final : public Deformer {
 public:
  /// Builds the cells. Errors: invalid_option; too_large (more cells than there may be).
  static Result<std::unique_ptr<RigidCells>> create(std::shared_ptr<const Shape> shape,
                                                    const RigidCellsOptions& options);
  ~RigidCells() override;

  const RigidCellsOptions& options() const;
  /// Changes transfer, hold, refine and stiffness; constraints and the deformation stay. Errors:
  /// invalid_option (also for any other change); then nothing has changed.
  Status set_options(const RigidCellsOptions& options);
  Status set_options(const NamedValues& given) override;
  NamedValues options_by_name() const override;

  /// Splits cells that differ much from their neighbours, if the options ask for it, and joins those
  /// again that no longer do; children inherit their parent's motion and the other way round.
  /// Returns how many cells were added and taken away. Errors: too_large.
  Result<Index> refine() override;

  Energy energy() const override;
  Counters counters() const override;
  Points point_positions() const override;
  Points point_normals() const override;
  Result<Points> transform_points(const Points& points) const override;

 protected:
  Status set_up() override;
  Start& take_targets() override;
  Result<StepReport> iterate(double tolerance) override;
  void do_reset() override;
  State do_save() const override;
  Status do_restore(const State& state) override;

 private:
  struct Impl;
  RigidCells(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl);
  /// Fixed points, then those of the handles, and where they should be.
  std::vector<Index> held_points() const;
  Points held_targets() const;

  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant
