#include "pliant/deformers/rigid_cells/carrier.h"

#include <utility>

#include "pliant/deformers/rigid_cells/blend.h"
#include "pliant/deformers/rigid_cells/pieces.h"

namespace pliant::cells {

void Carrier::forget_cells() {
  map_.reset();
  shape_.reset();
  of_pins_.reset();
}

void Carrier::hold(const Shape& shape, const CellTree& tree, const std::vector<Index>& points, const Points& targets) {
  if (points != held_points_) {
    held_points_ = points;
    const GridFrame& frame = tree.frame();
    pins_.set_up(shape.points()(Eigen::all, points), frame.unit * (1 << frame.depth));
    if (shape_ != nullptr) shape_->pins = pins_.reached(shape.points());
    of_pins_.reset();
  }
  pins_.set_targets(targets);
}

void Carrier::prepare(const MovedCells& cells) {
  if (transfer_ == CellTransfer::rbf && map_ == nullptr) map_ = std::make_unique<SmoothMap>(cells.tree);
}

Carrier::Passengers Carrier::board(const Points& points, const MovedCells& cells) {
  Passengers passengers;
  if (transfer_ == CellTransfer::rbf) {
    passengers.places = map_->place(points);
  } else {
    passengers.cells = nearest_cells(cells.tree.centers(), points);
  }
  passengers.pins = pins_.reached(points);
  return passengers;
}

Points Carrier::follow_cells(const Passengers& passengers, const Points& points, const MovedCells& cells) {
  Points carried;
  if (transfer_ == CellTransfer::rbf) {
    map_->set_motions(cells.motions, cells.model.origin);
    map_->carry(passengers.places, points, carried);
  } else {
    pliant::carry(cell_maps(cells.model.centers, cells.motions), passengers.cells, points, cells.model.origin, carried);
  }
  return carried;
}

Points Carrier::missed_by_pins(const MovedCells& cells) {
  if (of_pins_ == nullptr) of_pins_ = std::make_unique<Passengers>(board(pins_.rest(), cells));
  return pins_.targets() - follow_cells(*of_pins_, pins_.rest(), cells);
}

void Carrier::keep_pieces_rigid(const Shape& shape, Points& carried) const {
  if (pieces_.empty()) return;
  std::vector<bool> held(shape.points().cols(), false);
  for (const Index point : held_points_) held[point] = true;
  for (const std::vector<Index>& piece : pieces_) keep_rigid(piece, held, shape.points(), carried);
}

Points Carrier::carry_shape(const Shape& shape, const MovedCells& cells) {
  prepare(cells);
  if (shape_ == nullptr) {
    shape_ = std::make_unique<Passengers>(board(shape.points(), cells));
    const GridFrame& frame = cells.tree.frame();
    pieces_ = small_pieces(shape, frame.unit * (1 << frame.depth));
  }
  Points carried = follow_cells(*shape_, shape.points(), cells);
  Pins::add(shape_->pins, pins_.targets() - carried(Eigen::all, held_points_), carried);
  keep_pieces_rigid(shape, carried);
  carried(Eigen::all, held_points_) = pins_.targets();
  if (shape.dimension() == 2) carried.row(2).setZero();
  return carried;
}

Points Carrier::carry(const Shape& shape, const Points& points, const MovedCells& cells) {
  prepare(cells);
  const Passengers passengers = board(points, cells);
  Points carried = follow_cells(passengers, points, cells);
  Pins::add(passengers.pins, missed_by_pins(cells), carried);
  if (shape.dimension() == 2) carried.row(2) = points.row(2);
  return carried;
}

}  // namespace pliant::cells
