#include "pliant/deformers/rigid_cells/solver.h"

#include <algorithm>
#include <utility>

namespace pliant::cells {
namespace {

/// The linear system is solved to this part of its gradient, in at most so many iterations.
constexpr double kForcing = 1e-2;
constexpr int kMostInner = 60;
/// Steps are halved at most this often.
constexpr int kHalvings = 10;
/// After a step that takes more of the energy than this the memory starts anew: what was learnt
/// there says little about here.
constexpr double kFar = 0.02;

}  // namespace

void CellSolver::set_up(const CellModel& model, const std::vector<Freedom>& freedom) {
  model_ = &model;
  system_.set_up(model.corners, freedom, model.pairs);
  forget();
}

double CellSolver::linearize(const std::vector<CellMotion>& motions) {
  gradient_.setZero(6 * static_cast<Eigen::Index>(motions.size()));
  std::vector<Inertia>& stiffness = system_.stiffness();
  double sum = 0.0;
  for (std::size_t p = 0; p < model_->pairs.size(); ++p) {
    const auto [i, j] = model_->pairs[p];
    sum += model_->glue[p].linearize(motions[i], motions[j], stiffness[p], &gradient_[6 * i], &gradient_[6 * j]);
  }
  for (Index i = 0; i < static_cast<Index>(motions.size()); ++i) {
    if (system_.is_held(i)) gradient_.segment<6>(6 * i).setZero();
  }
  return sum;
}

void CellSolver::find_direction(Outcome& outcome) {
  memory_.direction(
      gradient_, [&](Eigen::VectorXd& d) { outcome.inner += system_.solve(d, kForcing, kMostInner); }, direction_);
}

bool CellSolver::descend(const std::vector<CellMotion>& motions, const std::vector<Hold>& holds, double before,
                         Outcome& outcome) {
  next_.resize(motions.size());
  outcome.promised = before > 0.0 ? -2.0 * gradient_.dot(direction_) / before : 0.0;
  double share = 1.0;
  for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
    for (std::size_t i = 0; i < motions.size(); ++i) next_[i] = moved(motions[i], &direction_[6 * i], share);
    apply(holds, *model_, next_);  // turning exactly about the points that are held
    outcome.energy = model_->energy(next_);
    if (!(outcome.energy <= before)) continue;
    outcome.decrease = before > 0.0 ? (before - outcome.energy) / before : 0.0;
    last_gradient_ = gradient_;
    last_step_ = share * direction_;
    remembers_ = outcome.decrease < kFar;
    return outcome.accepted = true;
  }
  return false;
}

CellSolver::Outcome CellSolver::step(std::vector<CellMotion>& motions, const std::vector<Hold>& holds) {
  const double before = linearize(motions);
  Points pivots = Points::Zero(3, model_->size());
  for (const Hold& hold : holds) pivots.col(hold.cell) = hold.target;
  system_.prepare(pivots);
  if (remembers_) {
    memory_.remember(last_step_, gradient_ - last_gradient_);
  } else {
    memory_.reset(gradient_.size());
  }
  Outcome outcome;
  find_direction(outcome);
  if (!descend(motions, holds, before, outcome) && !memory_.empty()) {
    memory_.clear();
    find_direction(outcome);
    descend(motions, holds, before, outcome);
  }
  if (!outcome.accepted) {
    outcome.energy = before;
    forget();
    return outcome;
  }
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double turned = (next_[i].rotation - motions[i].rotation).norm() * model_->sides[i];
    outcome.move = std::max(outcome.move, (next_[i].center - motions[i].center).norm() + turned);
  }
  std::swap(motions, next_);
  return outcome;
}

}  // namespace pliant::cells
