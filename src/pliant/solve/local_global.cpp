#include "pliant/solve/local_global.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/disjoint_sets.h"
#include "pliant/linalg/dense_kernels.h"

namespace pliant {
namespace {

/// A step must lower the energy by this part of what its slope promises (Armijo).
constexpr double kSufficient = 1e-4;
constexpr int kMaxHalvings = 40;
/// A gradient below this is rounding, over the largest coordinate and the diagonal of the matrix: terms cancel in it.
/// Nothing holds a part against steps of its own rounding, and a memory shared with parts that move makes them grow.
constexpr double kRounding = 1e-14;
/// What a full step would lower the energy by, over the energy, if that does not show in it.
constexpr double kInvisible = 1e-12;

}  // namespace

std::vector<Index> parts_of(const BlockMatrix& matrix) {
  DisjointSets sets(matrix.nodes);
  for (const auto& [a, b] : matrix.edges) sets.join(a, b);
  return sets.numbered().of;
}

std::vector<bool> hold_one_a_part(const std::vector<Index>& parts, std::vector<bool>& held) {
  std::vector<bool> holds(parts.size(), false), anchored(parts.size());  // of parts, of points
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (held[p]) holds[parts[p]] = true;
  }
  for (std::size_t p = 0; p < parts.size(); ++p) anchored[p] = holds[parts[p]];
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (holds[parts[p]]) continue;
    held[p] = true;
    holds[parts[p]] = true;
  }
  return anchored;
}

Status LocalGlobal::set_up(const BlockMatrix& matrix, std::vector<bool> held) {
  free_of_point_.assign(held.size(), -1);
  point_of_free_.clear();
  for (Index p = 0; p < matrix.nodes; ++p) {
    if (held[p]) continue;
    free_of_point_[p] = free_count();
    point_of_free_.push_back(p);
  }
  restart();
  for (Vector* v : {&gradient_, &direction_, &previous_, &step_}) v->setZero(unknowns());
  memory_.reset(unknowns());
  if (free_count() == 0) return {};
  const BlockMatrix system = reduced(matrix);
  part_of_free_ = parts_of(system);
  still_.assign(*std::max_element(part_of_free_.begin(), part_of_free_.end()) + 1, false);
  if (Status s = factor_.analyze(system); !s.ok()) return s;
  ++analyses_;
  return factorize(system);
}

Status LocalGlobal::refactorize(const BlockMatrix& matrix) {
  restart();
  memory_.clear();
  if (free_count() == 0) return {};
  return factorize(reduced(matrix));
}

Status LocalGlobal::factorize(const BlockMatrix& system) {
  ++factorizations_;
  diagonal_.assign(system.diagonal.begin(), system.diagonal.end());
  const Status status = factor_.factorize(system);
  if (status.ok()) factor_.allow_rough();
  return status;
}

BlockMatrix LocalGlobal::reduced(const BlockMatrix& matrix) {
  BlockMatrix system;
  std::vector<Edge> edges;
  std::vector<double> values;
  coupling_.clear();
  for (std::size_t e = 0; e < matrix.edges.size(); ++e) {
    const auto [a, b] = matrix.edges[e];
    const Index i = free_of_point_[a], j = free_of_point_[b];
    if (i >= 0 && j >= 0) {  // renumbering keeps the order
      edges.push_back({i, j});
      values.push_back(matrix.off_diagonal[e]);
    } else if (i >= 0 || j >= 0) {
      coupling_.push_back({i >= 0 ? Edge{i, b} : Edge{j, a}, matrix.off_diagonal[e]});
    }
  }
  system.set_zero(1, free_count(), std::move(edges));
  system.off_diagonal = std::move(values);
  for (Index i = 0; i < free_count(); ++i) system.diagonal[i] = matrix.diagonal[point_of_free_[i]];
  return system;
}

void LocalGlobal::gather(const Points& values, Vector& unknowns) const {
  const Index n = free_count();
  for (Index i = 0; i < n; ++i) {
    for (int a = 0; a < 3; ++a) unknowns[a * n + i] = values(a, point_of_free_[i]);
  }
}

void LocalGlobal::move(const Points& from, double alpha, const Vector& direction, Points& to) const {
  const Index n = free_count();
  to = from;
  for (Index i = 0; i < n; ++i) {
    for (int a = 0; a < 3; ++a) to(a, point_of_free_[i]) += alpha * direction[a * n + i];
  }
}

void LocalGlobal::extend(Points& values) {
  const Index n = free_count();
  if (n == 0) return;
  direction_.setZero();
  for (const auto& [ends, value] : coupling_) {
    for (int a = 0; a < 3; ++a) direction_[a * n + ends[0]] -= value * values(a, ends[1]);
  }
  factor_.solve(direction_.data(), 3);
  for (Index i = 0; i < n; ++i) {
    for (int a = 0; a < 3; ++a) values(a, point_of_free_[i]) = direction_[a * n + i];
  }
}

void LocalGlobal::relax(const Points& half_gradient, Points& x) {
  if (free_count() == 0) return;
  gather(half_gradient, direction_);
  factor_.solve(direction_.data(), 3);
  move(Points(x), -1.0, direction_, x);
}

void LocalGlobal::restart() {
  evaluated_ = false;
  approach_.restart();
}

void LocalGlobal::take_gradient(const Points& half_gradient, const Points& x) {
  gather(half_gradient, gradient_);
  const double rounding = kRounding * x.cwiseAbs().maxCoeff();
  std::fill(still_.begin(), still_.end(), true);
  auto still = static_cast<Index>(still_.size());
  for (Index i = 0; i < free_count() && still > 0; ++i) {  // one point tells that a part moves
    if (!still_[part_of_free_[i]]) continue;
    if (half_gradient.col(point_of_free_[i]).norm() > rounding * diagonal_[i]) {
      still_[part_of_free_[i]] = false;
      --still;
    }
  }
  clear_still(gradient_);
}

void LocalGlobal::clear_still(Vector& v) const {
  if (std::find(still_.begin(), still_.end(), true) == still_.end()) return;
  const Index n = free_count();
  for (Index i = 0; i < n; ++i) {
    if (!still_[part_of_free_[i]]) continue;
    for (int a = 0; a < 3; ++a) v[a * n + i] = 0.0;
  }
}

double LocalGlobal::find_direction(double slack) {
  // The classic step first: it needs no trial. Longer ones where the matrix is known to brake.
  const double length = memory_.empty() ? 1.0 : slack;
  memory_.direction(
      gradient_,
      [&](Vector& d) {
        factor_.solve_roughly(d.data());
        d *= length;
      },
      direction_);
  clear_still(direction_);
  return 2.0 * dense::dot(gradient_.data(), direction_.data(), direction_.size());
}

void LocalGlobal::accept(LocalModel& model, Points& x, double alpha, double energy) {
  model.accept();
  x.swap(trial_);
  previous_ = gradient_;
  take_gradient(half_gradient_, x);
  step_ = alpha * direction_;
  previous_ = gradient_ - previous_;
  memory_.remember(step_, previous_);
  energy_ = energy;
}

double LocalGlobal::longest_move() const {
  const Index n = free_count();
  const double *x = step_.data(), *y = x + n, *z = y + n;
  double longest = 0.0;
  for (Index i = 0; i < n; ++i) longest = std::max(longest, x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
  return std::sqrt(longest);
}

LocalGlobal::Outcome LocalGlobal::step(LocalModel& model, Points& x, double tolerance, double diagonal, double noise) {
  if (!evaluated_) {
    energy_ = model.evaluate(x, half_gradient_);
    model.accept();
    take_gradient(half_gradient_, x);
    evaluated_ = true;
  }
  if (free_count() == 0) return {false, true};
  double slope = find_direction(model.slack());
  if (!(slope < 0.0) && !memory_.empty()) {
    memory_.clear();
    slope = find_direction(model.slack());
  }
  double alpha = 1.0;
  for (int halvings = 0; slope < 0.0 && halvings < kMaxHalvings; ++halvings) {
    move(x, alpha, direction_, trial_);
    const double energy = model.evaluate(trial_, half_gradient_);
    if (energy < energy_ && energy <= energy_ + kSufficient * alpha * slope) {
      const double change = energy_ - energy;
      accept(model, x, alpha, energy);
      const double length = longest_move() / diagonal;
      approach_.add(length);
      const bool settled =
          change <= tolerance * std::max(std::abs(energy), noise) && std::max(length, approach_.left()) <= tolerance;
      return {true, settled};
    }
    // Lowest point of the parabola through both energies and the slope, within limits.
    const double lowest = -0.5 * slope * alpha / (energy - energy_ - alpha * slope) * alpha;
    alpha = std::isfinite(lowest) ? std::clamp(lowest, 0.1 * alpha, 0.5 * alpha) : 0.1 * alpha;
  }
  if (memory_.empty()) return {false, -slope <= kInvisible * std::max(std::abs(energy_), noise)};
  memory_.clear();  // once more along the plain direction before giving up
  return step(model, x, tolerance, diagonal, noise);
}

}  // namespace pliant
