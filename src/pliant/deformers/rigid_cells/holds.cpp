#include "pliant/deformers/rigid_cells/holds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pliant/core/sort.h"
#include "pliant/geometry/closest_rotation.h"

namespace pliant::cells {
namespace {

/// Points closer to a line than this, of their extent, lie on it.
constexpr double kStraight = 1e-6;

/// Fixed points, or a handle.
struct Grip {
  const Handle* handle = nullptr;                      ///< null: fixed
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of all of the handle
  bool leaves_turn_open = false;
};

/// A held point.
struct Contact {
  Index cell;
  const Grip* grip;
  Eigen::Vector3d rest, target;  ///< about the origin
};

/// The points of one cell that belong to one grip.
struct Touch {
  const Grip* grip;
  Eigen::Vector3d rest = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();  ///< sums
  Index count = 0;
  RigidFit fit;

  explicit Touch(const Grip* held_by) : grip(held_by) {}
  void add(const Contact& contact) {
    rest += contact.rest;
    target += contact.target;
    ++count;
    fit.add(contact.rest, contact.target);
  }
};

/// What touches one cell.
using Touches = std::vector<Touch>;

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
  if (touch.grip->handle == nullptr || touch.count < 3 || touch.target == touch.rest) return touch.grip->turn;
  const Eigen::Vector3d rest = touch.rest / touch.count, target = touch.target / touch.count;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-0.25, 0.25}) {
      const Eigen::Vector3d arm = sign * side * Eigen::Vector3d::Unit(axis);
      touch.fit.add(rest + arm, target + touch.grip->turn * arm);
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
  if (wanted == CellHold::points || (touches.size() == 1 && touches.front().grip->leaves_turn_open)) {
    hold.freedom = Freedom::turns;
    return hold;
  }
  const auto at_rest = [](const Touch& touch) {
    return touch.grip->turn.isIdentity(0.0) && touch.target == touch.rest;
  };
  if (touches.size() == 1) {
    hold.motion.rotation = turn_in_cell(touches.front(), model.sides[cell]);
  } else if (!std::all_of(touches.begin(), touches.end(), at_rest)) {
    RigidFit fit;
    for (const Touch& touch : touches) {
      const Eigen::Vector3d from = touch.rest / touch.count, to = touch.target / touch.count;
      fit.add(from, to);
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d arm = 0.25 * model.sides[cell] * Eigen::Vector3d::Unit(axis);
        fit.add(from + arm, to + touch.grip->turn * arm);
        fit.add(from - arm, to - touch.grip->turn * arm);
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
  std::vector<Contact> contacts;
  const auto touch = [&](Index point, const Grip& grip, const Eigen::Vector3d& rest, const Eigen::Vector3d& target) {
    contacts.push_back({cell_of_point[point], &grip, rest - model.origin, target - model.origin});
  };
  const Grip at_rest;
  for (const Index p : fixed) touch(p, at_rest, shape.points().col(p), shape.points().col(p));
  std::vector<Grip> grips;
  for (const Handle& handle : handles) grips.push_back({&handle, turn_of(handle), on_a_line(handle)});
  for (const Grip& grip : grips) {
    const Handle& handle = *grip.handle;
    for (Index i = 0; i < handle.rest.cols(); ++i) {
      touch(handle.points[i], grip, handle.rest.col(i), handle.targets.col(i));
    }
  }
  contacts = sorted_by(contacts, [](const Contact& contact) { return static_cast<std::uint64_t>(contact.cell); });
  std::vector<Hold> holds;
  Touches touches;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (touches.empty() || touches.back().grip != contact.grip) touches.emplace_back(contact.grip);
    touches.back().add(contact);
    if (c + 1 < contacts.size() && contacts[c + 1].cell == contact.cell) continue;
    holds.push_back(hold_of(contact.cell, touches, model, wanted));
    touches.clear();
  }
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
