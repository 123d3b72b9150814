// Where cells begin when targets have moved (solve/prediction.h).
#pragma once

#include <vector>

#include "pliant/deformers/rigid_cells/holds.h"
#include "pliant/solve/prediction.h"

namespace pliant::cells {

/// A cell of a small part that nothing holds, and the cell beside it that it moves with.
struct Rider {
  Index cell, host;
};

/// Finds the riders: cells of parts without a held cell that are smaller than `small` across.
/// held: of each cell.
std::vector<Rider> find_riders(const CellModel& model, const std::vector<bool>& held, double small);

/// Puts riders where their hosts take them.
void ride(const std::vector<Rider>& riders, const CellModel& model, std::vector<CellMotion>& motions);

/// Tries motions and keeps those with the least energy, everything that is held where it is held.
class CellStart final : public Start {
 public:
  /// Other cells are held. Keeps references to the model and to `riders`.
  void set_up(const CellModel& model, const std::vector<Index>& cell_of_point, const std::vector<Rider>& riders,
              const std::vector<Index>& fixed, const std::vector<Handle>& handles);
  /// Other targets: the motions that stand, and where cells are held now.
  void begin(std::vector<CellMotion> standing, std::vector<Hold> holds);
  /// The motions to start from.
  const std::vector<CellMotion>& motions() const { return begun_; }

  double small_turn() const override;
  Eigen::Vector3d standing(Index moved) const override;
  Index part_count() const override { return static_cast<Index>(floats_.size()); }
  bool floats(Index part) const override { return floats_[part]; }
  Index part_of(Index moved) const override { return part_[cells_[moved]]; }
  void try_rigid(const std::vector<PartMotion>& motions) override;
  void try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) override;

 private:
  std::vector<CellMotion> held(std::vector<CellMotion> motions) const;
  void keep_if_better(std::vector<CellMotion> motions, bool in_any_case);

  const CellModel* model_ = nullptr;
  const std::vector<Rider>* riders_ = nullptr;
  std::vector<Index> part_;                ///< of each cell
  std::vector<bool> floats_;               ///< of each part
  std::vector<Index> cells_;               ///< of each moved point
  Points rest_;                            ///< of the moved points, about the origin
  std::vector<std::vector<Index>> grips_;  ///< cells of each handle
  std::vector<Hold> holds_;
  std::vector<CellMotion> standing_, begun_;
  double energy_ = 0.0;  ///< of begun_
};

}  // namespace pliant::cells
