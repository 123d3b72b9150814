#include "pliant/deformers/rigid_cells/holds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pliant/geometry/closest_rotation.h"

namespace pliant::cells {
namespace {

/// Points closer to a line than this, of their extent, lie on it.
constexpr double kStraight = 1e-6;

/// The points of one cell that belong to one handle, or that are fixed.
struct Touch {
  Eigen::Vector3d rest = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();  ///< sums
  Index count = 0;
  const Handle* handle = nullptr;                      ///< null: fixed
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of all of the handle
  bool straight = false;                               ///< which leaves it open
  RigidFit fit;                                        ///< of these points
};

/// What touches one cell.
using Touches = std::vector<Touch>;

struct Collector {
  const CellModel& model;
  std::map<Index, Touches> by_cell;

  void add(Index cell, const Touch& like, const Eigen::Vector3d& rest, const Eigen::Vector3d& target) {
    Touches& touches = by_cell[cell];
    if (touches.empty() || touches.back().handle != like.handle) touches.push_back(like);
    Touch& touch = touches.back();
    const Eigen::Vector3d from = rest - model.origin, to = target - model.origin;
    touch.rest += from;
    touch.target += to;
    ++touch.count;
    touch.fit.add(from, to);
  }
};

Eigen::Matrix3d turn_of(const Handle& handle) {
  if (handle.targets == handle.rest) return Eigen::Matrix3d::Identity();  // exactly
  RigidFit fit;
  for (Index i = 0; i < handle.rest.cols(); ++i) fit.add(handle.rest.col(i), handle.targets.col(i));
  return fit.motion().rotation;
}

/// Whether the points of a handle lie on one line, or in one point.
bool on_a_line(const Handle& handle) {
  const Points away = handle.rest.colwise() - handle.rest.col(0);
  Index farthest = 0;
  const double extent = std::sqrt(away.colwise().squaredNorm().maxCoeff(&farthest));
  if (!(extent > 0.0)) return true;
  const Eigen::Vector3d along = away.col(farthest) / extent;
  const Points across = away - along * (along.transpose() * away);
  return std::sqrt(across.colwise().squaredNorm().maxCoeff()) <= kStraight * extent;
}

/// The turn of the handle, or, of targets that bend it, that of the points in the cell; pulled
/// towards the handle's where they say little.
Eigen::Matrix3d turn_in_cell(Touch& touch, double side) {
  if (touch.handle == nullptr || touch.count < 3 || touch.target == touch.rest) return touch.turn;
  const Eigen::Vector3d rest = touch.rest / touch.count, target = touch.target / touch.count;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-0.25, 0.25}) {
      const Eigen::Vector3d arm = sign * side * Eigen::Vector3d::Unit(axis);
      touch.fit.add(rest + arm, target + touch.turn * arm);
    }
  }
  return touch.fit.motion().rotation;
}

Hold hold_of(Index cell, Touches& touches, const CellModel& model, CellHold wanted) {
  Hold hold;
  hold.cell = cell;
  Eigen::Vector3d rest = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();
  Index count = 0;
  for (const Touch& touch : touches) {
    rest += touch.rest;
    target += touch.target;
    count += touch.count;
  }
  hold.point = rest / count;
  hold.target = target / count;
  if (wanted == CellHold::points || (touches.size() == 1 && touches.front().straight)) {
    hold.freedom = Freedom::turns;
    return hold;
  }
  const auto at_rest = [](const Touch& touch) { return touch.turn.isIdentity(0.0) && touch.target == touch.rest; };
  if (touches.size() == 1) {
    hold.motion.rotation = turn_in_cell(touches.front(), model.sides[cell]);
  } else if (!std::all_of(touches.begin(), touches.end(), at_rest)) {
    RigidFit fit;
    for (const Touch& touch : touches) {
      const Eigen::Vector3d from = touch.rest / touch.count, to = touch.target / touch.count;
      fit.add(from, to);
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d arm = 0.25 * model.sides[cell] * Eigen::Vector3d::Unit(axis);
        fit.add(from + arm, to + touch.turn * arm);
        fit.add(from - arm, to - touch.turn * arm);
      }
    }
    hold.motion.rotation = fit.motion().rotation;
  }
  hold.motion.center = held_center(hold, model, hold.motion.rotation);
  return hold;
}

}  // namespace

Eigen::Vector3d held_center(const Hold& hold, const CellModel& model, const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d center = model.centers.col(hold.cell), arm = center - hold.point;
  return center + ((rotation * arm - arm) + (hold.target - hold.point));
}

std::vector<Hold> find_holds(const CellModel& model, const Shape& shape, const std::vector<Index>& cell_of_point,
                             const std::vector<Index>& fixed, const std::vector<Handle>& handles, CellHold wanted) {
  Collector collector{model, {}};
  for (const Index p : fixed) {
    const Eigen::Vector3d place = shape.points().col(p);
    collector.add(cell_of_point[p], Touch(), place, place);
  }
  for (const Handle& handle : handles) {
    Touch like;
    like.handle = &handle;
    like.turn = turn_of(handle);
    like.straight = on_a_line(handle);
    for (Index i = 0; i < handle.rest.cols(); ++i) {
      collector.add(cell_of_point[handle.points[i]], like, handle.rest.col(i), handle.targets.col(i));
    }
  }
  std::vector<Hold> holds;
  for (auto& [cell, touches] : collector.by_cell) holds.push_back(hold_of(cell, touches, model, wanted));
  return holds;
}

void apply(const std::vector<Hold>& holds, const CellModel& model, std::vector<CellMotion>& motions) {
  for (const Hold& hold : holds) {
    CellMotion& motion = motions[hold.cell];
    if (hold.freedom == Freedom::held) {
      motion = hold.motion;
    } else {
      motion.center = held_center(hold, model, motion.rotation);
    }
  }
}

}  // namespace pliant::cells
