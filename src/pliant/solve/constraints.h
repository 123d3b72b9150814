// What a deformer is told: which points are fixed, which are moved, and where to.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"
#include "pliant/solve/handle.h"
#include "pliant/solve/state.h"

namespace pliant {

/// How far each handle was told to turn, axis times angle, in the order of the handles.
struct ToldTurns {
  std::vector<Eigen::Vector3d> of_handle;
  /// One of them by more than half a turn, which the points alone cannot show.
  bool beyond_half_turn = false;
};

/// Handles and fixed points, never sharing a point. Every call checks its arguments and on error
/// changes nothing; vertex ids are those of the shape's input. For messages see Deformer.
class Constraints {
 public:
  explicit Constraints(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}

  /// Value: whether the fixed points are others than before.
  Result<bool> set_fixed(std::span<const Index> vertices);
  Result<HandleId> add_handle(std::span<const Index> vertices);
  Status remove_handle(HandleId id);
  Status move_handle(HandleId id, const Motion& motion);
  Status set_targets(HandleId id, const Points& targets);
  /// Targets return to rest.
  void reset();

  /// Writes the handles as tables.
  void save(State& state) const;
  /// Whether `restore` can read what a state says of handles, if it does. Errors: invalid_option.
  Status check(const State& state) const;
  /// Takes over targets of handles with the same vertices. How far any has turned is not known then.
  void restore(const State& state);

  const std::vector<Index>& fixed_points() const { return fixed_points_; }
  const std::vector<Handle>& handles() const { return handles_; }
  /// Points of all handles, one handle after the other, and their targets.
  std::vector<Index> moved_points() const;
  Points targets() const;
  /// Which of all points are fixed or moved.
  std::vector<bool> held() const;

  /// How far each handle was told to turn since the last call.
  ToldTurns take_turns();

 private:
  /// What belongs to a handle and is nobody else's business.
  struct Private {
    Index given;              ///< length of the caller's lists
    std::vector<Index> kept;  ///< column of each point: copies at one position stand for one point
    /// The motion when turns were last taken; empty: not known.
    std::optional<Motion> taken = Motion{};
  };

  Result<std::vector<Index>> checked_points(std::span<const Index> vertices, const char* argument,
                                            std::vector<Index>* kept) const;
  /// The index of a handle. Errors: invalid_handle.
  Result<std::size_t> find(HandleId id) const;

  std::shared_ptr<const Shape> shape_;
  std::vector<Index> fixed_points_;  ///< ascending
  std::vector<Handle> handles_;
  std::vector<Private> private_;  ///< beside handles_
  HandleId next_id_ = 1;
};

}  // namespace pliant
