// The deformers of one family: unknowns are the points of the shape, one constant matrix is
// factorised once a grab, every step costs one solve and one pass over the shape.
#pragma once

#include <memory>
#include <optional>

#include "pliant/solve/deformer.h"
#include "pliant/solve/local_model.h"

namespace pliant {

/// Fixed points stand at rest, handles at their targets: both leave the unknowns (handles stay
/// among them where they are soft). A part of the shape without any of them keeps one point where
/// it is.
///
/// A step goes along a quasi-Newton direction in the metric of the constant matrix: the first one
/// is the classic local-global step, and the minimum is the same. Large motions of handles start
/// from a prediction where that has less energy; a turn told by Motion::angle counts beyond half a
/// turn.
class LocalGlobalDeformer : public Deformer {
 public:
  ~LocalGlobalDeformer() override;

  Counters counters() const override;
  Points point_positions() const override;
  Points point_normals() const override;

 protected:
  explicit LocalGlobalDeformer(std::shared_ptr<const Shape> shape);

  /// The energy of the method.
  virtual LocalModel& model() const = 0;

  /// Exact handles (empty) or soft ones with this weight.
  void set_constraint_weight(std::optional<double> weight);
  /// After a change of the model that leaves the matrix as it is.
  void energy_changed();

  /// Evaluates the model where the deformation stands, handles at their targets: E and, with soft
  /// handles, the unweighted sum of squared distances.
  struct Terms {
    double model = 0.0;
    double constraint = 0.0;
  };
  Terms evaluate_terms() const;
  /// `result`, one row an input vertex.
  void save_result(State& state) const;

  Status set_up() override;
  Status refactorize() override;
  Start& take_targets() override;
  Result<StepReport> iterate(double tolerance) override;
  void do_reset() override;
  /// Needs `result`; what is local follows from it.
  Status do_restore(const State& state) override;

 private:
  struct Core;
  std::unique_ptr<Core> core_;
};

}  // namespace pliant
