// How the shape, and any other points, follow the cells (Botsch 2007, section 6).
#pragma once

#include <memory>
#include <vector>

#include "pliant/deformers/rigid_cells/model.h"
#include "pliant/deformers/rigid_cells/options.h"
#include "pliant/deformers/rigid_cells/pins.h"
#include "pliant/deformers/rigid_cells/smooth_map.h"

namespace pliant::cells {

/// The cells as they are now.
struct MovedCells {
  const CellTree& tree;
  const CellModel& model;
  const std::vector<CellMotion>& motions;
};

/// What it needs is found when points are first asked for, and kept while cells and held points are
/// the same.
class Carrier {
 public:
  /// There are other cells.
  void forget_cells();
  void set_transfer(CellTransfer transfer) { transfer_ = transfer; }
  /// Points of the shape that are held, and where: 3 x |points|.
  void hold(const Shape& shape, const CellTree& tree, const std::vector<Index>& points, const Points& targets);

  const std::vector<Index>& held_points() const { return held_points_; }
  const Points& targets() const { return pins_.targets(); }

  /// Exactly the points where nothing has moved, exactly the targets of points that are held; in the
  /// plane z is 0.
  Points carry_shape(const Shape& shape, const MovedCells& cells);
  /// points: 3 x n, in the scene.
  Points carry(const Shape& shape, const Points& points, const MovedCells& cells);

 private:
  /// A set of points, and how they follow.
  struct Passengers {
    SmoothMap::Places places;
    Influences cells;
    Pins::Reached pins;
  };
  void prepare(const MovedCells& cells);
  Passengers board(const Points& points, const MovedCells& cells);
  Points follow_cells(const Passengers& passengers, const Points& points, const MovedCells& cells);
  Points missed_by_pins(const MovedCells& cells);
  void keep_pieces_rigid(const Shape& shape, Points& carried) const;

  CellTransfer transfer_ = CellTransfer::rbf;
  std::unique_ptr<SmoothMap> map_;
  std::unique_ptr<Passengers> shape_, of_pins_;
  std::vector<std::vector<Index>> pieces_;  ///< of the shape, that stay rigid
  std::vector<Index> held_points_;
  Pins pins_;
};

}  // namespace pliant::cells
