// THE interface: every method is a Deformer. Bindings, demo, command and benches know nothing else.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pliant/solve/deformation.h"
#include "pliant/solve/handle.h"

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
class Deformer : public Deformation {
 public:
  using Deformation::Deformation;

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
  virtual Energy energy() const = 0;
  virtual Counters counters() const = 0;

  // -- Results.
  Points positions() const final { return shape().scatter(point_positions()); }
  Points normals() const final { return shape().scatter(point_normals()); }
  /// Deformed positions of the shape's points, 3 x p.
  virtual Points point_positions() const = 0;
  virtual Points point_normals() const = 0;
  void reset() final;

  const std::vector<Index>& fixed_points() const { return fixed_points_; }
  const std::vector<Handle>& handles() const { return handles_; }

 protected:
  /// The set of constrained points changed.
  virtual void constraints_changed() = 0;
  /// Only targets changed.
  virtual void targets_changed() = 0;
  virtual Result<StepReport> do_step(double tolerance) = 0;
  virtual void do_reset() = 0;

  void save_handles(State& state) const;
  Status restore_handles(const State& state);

 private:
  Result<std::vector<Index>> checked_points(std::span<const Index> vertices, const char* argument,
                                            std::vector<Index>* kept) const;
  Handle* find(HandleId id);

  std::vector<Index> fixed_points_;
  std::vector<Handle> handles_;
  /// How the columns of a caller's target list belong to the points of a handle.
  struct Columns {
    Index given;              ///< length of the caller's list
    std::vector<Index> kept;  ///< column of each point: copies at one position stand for one point
  };
  std::vector<Columns> columns_;  ///< beside handles_
  HandleId next_id_ = 1;
};

}  // namespace pliant
