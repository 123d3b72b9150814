// THE interface: every method is a Deformer. Bindings, demo, command and benches know nothing else.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pliant/core/named_values.h"
#include "pliant/solve/constraints.h"
#include "pliant/solve/deformation.h"
#include "pliant/solve/prediction.h"

namespace pliant {

/// One term of an energy: `value` is unweighted, the total is the sum of weight * value.
struct EnergyTerm {
  std::string name;
  double value = 0.0;
  double weight = 1.0;
};

struct Energy {
  double total = 0.0;
  std::vector<EnergyTerm> terms;
};

/// What one iteration did.
struct StepReport {
  int iteration = 0;       ///< accepted steps since the constraints last changed
  double energy = 0.0;     ///< after the step
  bool accepted = true;    ///< false: no step lowers the energy any more
  bool converged = false;  ///< the method's own test holds at the given tolerance
};

/// What solving has cost since construction.
struct Counters {
  Index unknowns = 0;      ///< scalar unknowns of the current system
  int factorizations = 0;  ///< numerical factorisations
  int analyses = 0;        ///< symbolic ones
};

/// A shape, constraints on it, and a method that finds the deformation. `reset` keeps handles and
/// the fixed region, targets return to rest; `restore` brings targets back, too, of handles with
/// the same vertices.
///
/// A method implements what stands under `protected` and the results; it never looks after handles,
/// targets, or what has changed since the last step.
class Deformer : public Deformation {
 public:
  explicit Deformer(std::shared_ptr<const Shape> shape) : Deformation(shape), constraints_(std::move(shape)) {}

  // -- On grab: the pattern of the system changes, the next step factorises.
  /// Replaces the fixed region (empty: none). Errors: invalid_handle (id out of range, duplicate,
  /// vertex of a handle). On error nothing changes.
  Status set_fixed(std::span<const Index> vertices);
  /// Adds a handle at rest. Errors as above, and for no vertices or a vertex of another handle.
  Result<HandleId> add_handle(std::span<const Index> vertices);
  Status remove_handle(HandleId id);

  // -- On drag: only the right-hand side changes.
  Status move_handle(HandleId id, const Motion& motion);
  /// targets: 3 x |vertices of the handle|, in the order the handle was given.
  Status set_targets(HandleId id, const Points& targets);

  // -- Solving.
  /// One iteration. tolerance: of the method's own stop test.
  /// Errors: not_solvable, too_large (on the first step of a grab); the state is then unchanged.
  Result<StepReport> step(double tolerance = 1e-6);
  /// Terms at the current deformation and targets.
  /// Improves the model where a converged solution falls short, once, if the options ask for it.
  /// Returns how many parts were added; above 0 there is more to solve. Errors: too_large.
  virtual Result<Index> refine() { return Index{0}; }
  virtual Energy energy() const = 0;
  virtual Counters counters() const = 0;

  // -- Options.
  /// Changes options of a living deformer by their names; those not given stay, as do handles,
  /// targets and the deformation. Errors: invalid_option (here: nothing may change); then nothing
  /// has changed.
  virtual Status set_options(const NamedValues& given);
  /// The options in use: what build_deformer takes.
  virtual NamedValues options_by_name() const = 0;

  // -- Results.
  Points positions() const final { return shape().scatter(point_positions()); }
  Points normals() const final { return shape().scatter(point_normals()); }
  /// Deformed positions of the shape's points, 3 x p.
  virtual Points point_positions() const = 0;
  virtual Points point_normals() const = 0;
  /// Directions the material has, 3 x n, unit or zero, one a vertex, for drawing them.
  /// Errors: not_solvable where there are none, as here.
  virtual Result<Points> field() const;
  void reset() final;
  State save() const final;
  Status restore(const State& state) final;

  const std::vector<Index>& fixed_points() const { return constraints_.fixed_points(); }
  const std::vector<Handle>& handles() const { return constraints_.handles(); }

 protected:
  const Constraints& constraints() const { return constraints_; }

  // What a step calls, as little as has changed. After an error nothing has.
  /// Other points are held: the pattern of the system is another. Analyses and factorises.
  virtual Status set_up() = 0;
  /// Other values in the same pattern.
  virtual Status refactorize() { return set_up(); }
  /// Other targets, also after `set_up`. What is to be started anew from them (prediction.h).
  virtual Start& take_targets() = 0;
  /// One iteration; `iteration` of the report is filled in by the caller.
  virtual Result<StepReport> iterate(double tolerance) = 0;

  /// Back to rest. Targets are there already.
  virtual void do_reset() = 0;
  /// All but the handles.
  virtual State do_save() const = 0;
  virtual Status do_restore(const State& state) = 0;

  /// For options of a living deformer: the next step calls `set_up` or `refactorize`.
  void pattern_changed() { stale_.pattern = true; }
  void matrix_changed() { stale_.matrix = true; }
  /// Whether a step has taken all that was set since.
  bool up_to_date() const { return !stale_.pattern && !stale_.matrix && !stale_.targets; }

 private:
  Status take_changes();

  Constraints constraints_;
  /// What has changed since a step took it.
  struct Stale {
    bool pattern = true, matrix = false, targets = true;
  };
  Stale stale_;
  int iteration_ = 0;
};

}  // namespace pliant
