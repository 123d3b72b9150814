#include "pliant/deformers/rigid_cells/start.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/deformers/rigid_cells/laplacian.h"
#include "pliant/geometry/closest_rotation.h"

namespace pliant::cells {
namespace {

/// Newton's method copes with smaller turns by itself.
constexpr double kSmallTurn = std::numbers::pi / 3.0;

}  // namespace

std::vector<Rider> find_riders(const CellModel& model, const std::vector<bool>& held, double small) {
  const std::vector<Index> part = model.parts();
  const Index parts = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
  std::vector<bool> is_held(parts, false);
  std::vector<Eigen::AlignedBox3d> extent(parts);
  for (Index i = 0; i < model.size(); ++i) {
    if (held[i]) is_held[part[i]] = true;
    extent[part[i]].extend(model.centers.col(i));
  }
  std::vector<Index> host(parts, -1);
  for (Index k = 0; k < parts; ++k) {
    if (is_held[k] || extent[k].diagonal().norm() > small) continue;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.size(); ++i) {
      const double distance = (model.centers.col(i) - extent[k].center()).squaredNorm();
      if (is_held[part[i]] && distance < least) {
        least = distance;
        host[k] = i;
      }
    }
  }
  std::vector<Rider> riders;
  for (Index i = 0; i < model.size(); ++i) {
    if (host[part[i]] >= 0) riders.push_back({i, host[part[i]]});
  }
  return riders;
}

void ride(const std::vector<Rider>& riders, const CellModel& model, std::vector<CellMotion>& motions) {
  for (const Rider& rider : riders) {
    const CellMotion& host = motions[rider.host];
    const Eigen::Vector3d center = model.centers.col(rider.cell), arm = center - model.centers.col(rider.host);
    motions[rider.cell].rotation = host.rotation;
    motions[rider.cell].center = center + ((host.rotation * arm - arm) + (host.center - model.centers.col(rider.host)));
  }
}

void CellStart::set_up(const CellModel& model, const std::vector<Index>& cell_of_point,
                       const std::vector<Rider>& riders, const std::vector<Index>& fixed,
                       const std::vector<Handle>& handles) {
  model_ = &model;
  riders_ = &riders;
  part_ = model.parts();
  floats_.assign(part_.empty() ? 0 : *std::max_element(part_.begin(), part_.end()) + 1, true);
  for (const Index point : fixed) floats_[part_[cell_of_point[point]]] = false;
  cells_.clear();
  grips_.clear();
  for (const Handle& handle : handles) {
    grips_.emplace_back();
    for (const Index point : handle.points) grips_.back().push_back(cell_of_point[point]);
    cells_.insert(cells_.end(), grips_.back().begin(), grips_.back().end());
  }
  rest_.resize(3, static_cast<Index>(cells_.size()));
  Index first = 0;
  for (const Handle& handle : handles) {
    rest_.middleCols(first, handle.rest.cols()) = handle.rest.colwise() - model.origin;
    first += static_cast<Index>(handle.rest.cols());
  }
}

void CellStart::begin(std::vector<CellMotion> standing, std::vector<Hold> holds) {
  standing_ = std::move(standing);
  holds_ = std::move(holds);
  begun_ = held(standing_);
  energy_ = model_->energy(begun_);
}

std::vector<CellMotion> CellStart::held(std::vector<CellMotion> motions) const {
  apply(holds_, *model_, motions);
  ride(*riders_, *model_, motions);
  return motions;
}

void CellStart::keep_if_better(std::vector<CellMotion> motions, bool in_any_case) {
  std::vector<CellMotion> candidate = held(motions);
  const double energy = model_->energy(candidate);
  if (!in_any_case && !(energy < energy_)) return;
  standing_ = std::move(motions);
  begun_ = std::move(candidate);
  energy_ = energy;
}

double CellStart::small_turn() const { return kSmallTurn; }

Eigen::Vector3d CellStart::standing(Index moved) const {
  const Index cell = cells_[moved];
  const CellMotion& motion = standing_[cell];
  return motion.rotation * (rest_.col(moved) - model_->centers.col(cell)) + motion.center + model_->origin;
}

void CellStart::try_rigid(const std::vector<PartMotion>& motions) {
  std::vector<CellMotion> tried = standing_;
  for (const PartMotion& of_part : motions) {
    const RigidMotion& motion = of_part.motion;
    for (Index i = 0; i < model_->size(); ++i) {
      if (part_[i] != of_part.part) continue;
      tried[i].rotation = motion.rotation * tried[i].rotation;
      tried[i].center = motion.rotation * (tried[i].center + model_->origin) + motion.translation - model_->origin;
    }
  }
  keep_if_better(std::move(tried), false);
}

void CellStart::try_turned(const std::vector<Eigen::Vector3d>& turns, bool in_any_case) {
  std::vector<bool> is_held(model_->size(), false);
  for (const Hold& hold : holds_) is_held[hold.cell] = true;
  std::vector<Eigen::Vector3d> turned(model_->size(), Eigen::Vector3d::Zero());
  for (std::size_t h = 0; h < grips_.size(); ++h) {
    const Eigen::VectorXd share = harmonic_shares(*model_, is_held, grips_[h]);
    for (Index i = 0; i < model_->size(); ++i) turned[i] += share[i] * turns[h];
  }
  std::vector<CellMotion> tried = standing_;
  for (Index i = 0; i < model_->size(); ++i) tried[i].rotation = rotation_of(turned[i]) * tried[i].rotation;
  apply(holds_, *model_, tried);
  settle_centers(*model_, is_held, tried);
  keep_if_better(std::move(tried), in_any_case);
}

}  // namespace pliant::cells
