#include "pliant/solve/prediction.h"

#include <algorithm>

#include "pliant/geometry/closest_rotation.h"

namespace pliant {
namespace {

/// So many points of a handle, evenly picked, tell its turn well enough.
constexpr std::size_t kEnoughForTurn = 250;

bool anything_floats(const Start& start) {
  for (Index part = 0; part < start.part_count(); ++part) {
    if (start.floats(part)) return true;
  }
  return false;
}

void follow_rigidly(const std::vector<Handle>& handles, Start& start) {
  if (!anything_floats(start)) return;
  std::vector<RigidFit> fits(start.part_count());
  std::vector<bool> asked(start.part_count(), false);
  Index moved = 0;
  for (const Handle& handle : handles) {
    for (const auto& target : handle.targets.colwise()) {
      const Index part = start.part_of(moved);
      if (part >= 0 && start.floats(part)) {
        fits[part].add(start.standing(moved), target);
        asked[part] = true;
      }
      ++moved;
    }
  }
  std::vector<Start::PartMotion> motions;
  for (Index part = 0; part < start.part_count(); ++part) {
    if (asked[part]) motions.push_back({part, fits[part].motion()});
  }
  if (!motions.empty()) start.try_rigid(motions);
}

/// How far each handle turns from where its points stand.
std::vector<Eigen::Vector3d> shown_turns(const std::vector<Handle>& handles, const Start& start) {
  std::vector<Eigen::Vector3d> turns;
  Index first = 0;
  for (const Handle& handle : handles) {
    RigidFit fit;
    const std::size_t size = handle.points.size(), stride = std::max<std::size_t>(1, size / kEnoughForTurn);
    for (std::size_t i = 0; i < size; i += stride) {
      fit.add(start.standing(first + static_cast<Index>(i)), handle.targets.col(static_cast<Index>(i)));
    }
    turns.push_back(rotation_vector_of(fit.motion().rotation));
    first += static_cast<Index>(size);
  }
  return turns;
}

}  // namespace

void predict(Constraints& constraints, Start& start) {
  ToldTurns told = constraints.take_turns();
  if (!told.beyond_half_turn) follow_rigidly(constraints.handles(), start);
  // Where no turn is told beyond what the points show, the points know better: the shape may lag.
  const std::vector<Eigen::Vector3d> turns =
      told.beyond_half_turn ? std::move(told.of_handle) : shown_turns(constraints.handles(), start);
  const bool small = std::all_of(turns.begin(), turns.end(),
                                 [&](const Eigen::Vector3d& turn) { return turn.norm() < start.small_turn(); });
  if (!small) start.try_turned(turns, told.beyond_half_turn);
}

}  // namespace pliant
