#include "pliant/deformers/rigid_cells/multigrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pliant/core/disjoint_sets.h"
#include "pliant/core/sort.h"
#include "pliant/linalg/dense_kernels.h"
#include "pliant/linalg/substitution.h"

namespace pliant::cells {
namespace {

/// So many bodies, or a few more, are solved for exactly.
constexpr Index kCoarsest = 24, kMostExact = 100;
/// How much coarse corrections are stretched; 2 would be right for smooth motions alone.
constexpr double kStretch = 1.6;
/// Ties every body to where it is, so that parts nothing holds leave the system definite.
constexpr double kTie = 1e-9;

}  // namespace

void Multigrid::set_up(std::vector<Eigen::Vector3i> at, const std::vector<Freedom>& freedom,
                       const std::vector<std::array<Index, 2>>& pairs) {
  levels_.clear();
  Level finest;
  finest.size = static_cast<Index>(at.size());
  finest.pairs = pairs;
  finest.freedom = freedom;
  levels_.push_back(std::move(finest));
  for (int width = 2; levels_.back().size > kCoarsest && width < (1 << 24); width *= 2) {
    Level coarse;
    std::vector<Index> parent, pair_parent;
    if (!coarsen(levels_.back(), at, width, coarse, parent, pair_parent)) continue;
    levels_.back().parent = std::move(parent);
    levels_.back().pair_parent = std::move(pair_parent);
    levels_.push_back(std::move(coarse));
  }
  for (Level& level : levels_) link(level);
  product_.setZero(6 * static_cast<Eigen::Index>(freedom.size()));
  const Index coarsest = levels_.back().size;
  const bool exact = coarsest <= kMostExact && levels_.size() > 1;
  const std::size_t rows = exact ? 6 * static_cast<std::size_t>(coarsest) : 0;
  dense_.assign(rows * rows, 0.0);
  dense_packed_.resize(dense::packed_size(rows));
}

bool Multigrid::coarsen(const Level& fine, std::vector<Eigen::Vector3i>& at, int width, Level& coarse,
                        std::vector<Index>& parent, std::vector<Index>& pair_parent) const {
  const auto cube = [&](Index i) { return Eigen::Vector3i(at[i] / width); };
  const auto is_free = [&](Index i) { return fine.freedom[i] == Freedom::free; };
  DisjointSets bodies(fine.size);
  for (const auto& [i, j] : fine.pairs) {
    if (is_free(i) && is_free(j) && cube(i) == cube(j)) bodies.join(i, j);
  }
  parent.assign(fine.size, -1);
  std::vector<Eigen::Vector3i> coarse_at;
  const std::vector<Index> roots = bodies.roots();
  for (Index i = 0; i < fine.size; ++i) {
    if (!is_free(i)) continue;
    if (roots[i] == i) {
      parent[i] = static_cast<Index>(coarse_at.size());
      coarse_at.push_back(cube(i) * width);
    } else {
      parent[i] = parent[roots[i]];
    }
  }
  coarse.size = static_cast<Index>(coarse_at.size());
  if (coarse.size == 0 || 4 * coarse.size > 3 * fine.size) return false;
  coarse.freedom.assign(coarse.size, Freedom::free);
  std::vector<Keyed> between;
  for (const auto& [i, j] : fine.pairs) {
    const Index a = parent[i], b = parent[j];
    if (a >= 0 && b >= 0 && a != b) {
      between.push_back({key_of(std::min(a, b), std::max(a, b)), static_cast<Index>(pair_parent.size())});
    }
    pair_parent.push_back(a == b ? kInside : kGround - std::max(a, b));
  }
  sort_keyed(between);
  for (std::size_t k = 0; k < between.size(); ++k) {
    if (k == 0 || between[k].key != between[k - 1].key) {
      const auto [i, j] = fine.pairs[between[k].index];
      coarse.pairs.push_back({std::min(parent[i], parent[j]), std::max(parent[i], parent[j])});
    }
    pair_parent[between[k].index] = static_cast<Index>(coarse.pairs.size()) - 1;
  }
  at = std::move(coarse_at);
  return true;
}

void Multigrid::link(Level& level) {
  level.stiffness.assign(level.pairs.size(), {});
  level.ground.assign(level.size, {});
  level.inverse.assign(level.size, {});
  level.offsets.assign(level.size + 1, 0);
  for (const auto& [i, j] : level.pairs) {
    ++level.offsets[i + 1];
    ++level.offsets[j + 1];
  }
  for (Index i = 0; i < level.size; ++i) level.offsets[i + 1] += level.offsets[i];
  level.neighbours.resize(2 * level.pairs.size());
  std::vector<Index> next(level.offsets.begin(), level.offsets.end() - 1);
  // Sorted pairs: first those before a node, ascending, then those after it.
  for (std::size_t p = 0; p < level.pairs.size(); ++p) {
    const auto [i, j] = level.pairs[p];
    level.neighbours[next[j]++] = {i, static_cast<Index>(p)};
  }
  level.later = next;
  for (std::size_t p = 0; p < level.pairs.size(); ++p) {
    const auto [i, j] = level.pairs[p];
    level.neighbours[next[i]++] = {j, static_cast<Index>(p)};
  }
  for (auto* vector : {&level.b, &level.x, &level.first, &level.product})
    vector->assign(6 * static_cast<std::size_t>(level.size), 0.0);
}

void Multigrid::invert_diagonal(Level& level, const Points* pivots) {
  for (Index i = 0; i < level.size; ++i) {
    level.inverse[i] = Compliance();
    if (level.freedom[i] == Freedom::held) continue;
    Inertia sum = level.ground[i];
    for (Index at = level.offsets[i]; at < level.offsets[i + 1]; ++at) {
      sum += level.stiffness[level.neighbours[at].pair];
    }
    const Inertia tie = sum.scaled(kTie);
    level.ground[i] += tie;
    sum += tie;
    level.inverse[i] =
        level.freedom[i] == Freedom::free ? Compliance::of_free(sum) : Compliance::about(sum, pivots->col(i));
  }
}

void Multigrid::prepare(const Points& pivots) {
  Level& finest = levels_.front();
  std::fill(finest.ground.begin(), finest.ground.end(), Inertia());
  invert_diagonal(finest, &pivots);
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    const Level& fine = levels_[l];
    Level& coarse = levels_[l + 1];
    std::fill(coarse.stiffness.begin(), coarse.stiffness.end(), Inertia());
    std::fill(coarse.ground.begin(), coarse.ground.end(), Inertia());
    for (std::size_t p = 0; p < fine.pairs.size(); ++p) {
      const Index to = fine.pair_parent[p];
      if (to >= 0) coarse.stiffness[to] += fine.stiffness[p];
      if (to <= kGround) coarse.ground[kGround - to] += fine.stiffness[p];
    }
    for (Index i = 0; i < fine.size; ++i) {
      if (fine.parent[i] >= 0) coarse.ground[fine.parent[i]] += fine.ground[i];
    }
    invert_diagonal(coarse, nullptr);
  }
  factorize_coarsest();
}

void Multigrid::factorize_coarsest() {
  const Level& level = levels_.back();
  if (dense_.empty()) return;
  const std::ptrdiff_t rows = 6 * static_cast<std::ptrdiff_t>(level.size);
  std::fill(dense_.begin(), dense_.end(), 0.0);
  const auto add = [&](Index i, Index j, const Inertia& inertia, double sign) {
    const Eigen::Matrix<double, 6, 6> block = sign * inertia.dense();
    for (int c = 0; c < 6; ++c) {
      for (int r = 0; r < 6; ++r) dense_[(6 * j + c) * rows + 6 * i + r] += block(r, c);
    }
  };
  for (Index i = 0; i < level.size; ++i) add(i, i, level.ground[i], 1.0);
  for (std::size_t p = 0; p < level.pairs.size(); ++p) {
    const auto [i, j] = level.pairs[p];
    add(i, i, level.stiffness[p], 1.0);
    add(j, j, level.stiffness[p], 1.0);
    add(j, i, level.stiffness[p], -1.0);
  }
  dense::factorize_panel(dense_.data(), rows, static_cast<int>(rows), static_cast<int>(rows), dense_packed_.data());
}

void Multigrid::solve_coarsest(Level& level) {
  const int rows = 6 * level.size;
  level.x = level.b;
  dense::forward_panel<dense::One>(dense_.data(), rows, rows, level.x.data(), nullptr);
  dense::backward_panel<dense::One>(dense_.data(), rows, rows, level.x.data(), nullptr);
}

void Multigrid::sweep_forwards(Level& level) {
  // From zero: only what comes before a node counts.
  double* x = level.x.data();
  for (Index i = 0; i < level.size; ++i) {
    double sum[6];
    std::copy_n(level.b.data() + 6 * i, 6, sum);
    for (Index at = level.offsets[i]; at < level.later[i]; ++at) {
      const Neighbour& other = level.neighbours[at];
      level.stiffness[other.pair].apply(x + 6 * other.node, sum);
    }
    level.inverse[i].apply(sum, x + 6 * i);
  }
}

void Multigrid::sweep_backwards(Level& level) {
  double* x = level.x.data();
  for (Index i = level.size - 1; i >= 0; --i) {
    double sum[6];
    std::copy_n(level.b.data() + 6 * i, 6, sum);
    for (Index at = level.offsets[i]; at < level.offsets[i + 1]; ++at) {
      const Neighbour& other = level.neighbours[at];
      level.stiffness[other.pair].apply(x + 6 * other.node, sum);
    }
    level.inverse[i].apply(sum, x + 6 * i);
  }
}

void Multigrid::restrict_residual(const Level& fine, Level& coarse) {
  // After a sweep forwards from zero a node lacks what came after it.
  std::fill(coarse.b.begin(), coarse.b.end(), 0.0);
  for (Index i = 0; i < fine.size; ++i) {
    if (fine.parent[i] < 0) continue;
    double* sum = coarse.b.data() + 6 * fine.parent[i];
    for (Index at = fine.later[i]; at < fine.offsets[i + 1]; ++at) {
      const Neighbour& other = fine.neighbours[at];
      fine.stiffness[other.pair].apply(fine.x.data() + 6 * other.node, sum);
    }
  }
}

void Multigrid::prolong(const Level& coarse, Level& fine) {
  for (Index i = 0; i < fine.size; ++i) {
    if (fine.parent[i] < 0) continue;
    const double* from = coarse.x.data() + 6 * fine.parent[i];
    for (int k = 0; k < 6; ++k) fine.x[6 * i + k] += kStretch * from[k];
  }
}

void Multigrid::cycle(std::size_t l) {
  Level& level = levels_[l];
  const bool coarsest = l + 1 == levels_.size();
  if (coarsest && !dense_.empty()) return solve_coarsest(level);
  sweep_forwards(level);
  if (!coarsest) {
    restrict_residual(level, levels_[l + 1]);
    cycle_twice(l + 1);
    prolong(levels_[l + 1], level);
  }
  sweep_backwards(level);
}

void Multigrid::cycle_twice(std::size_t l) {
  cycle(l);
  if (l + 1 == levels_.size()) return;
  Level& level = levels_[l];
  level.first = level.x;
  multiply(level, level.first.data(), level.product.data());
  for (std::size_t k = 0; k < level.b.size(); ++k) level.b[k] -= level.product[k];
  cycle(l);
  for (std::size_t k = 0; k < level.x.size(); ++k) level.x[k] += level.first[k];
}

void Multigrid::multiply(const Level& level, const double* x, double* y) {
  std::fill_n(y, 6 * static_cast<std::size_t>(level.size), 0.0);
  for (Index i = 0; i < level.size; ++i) level.ground[i].apply(x + 6 * i, y + 6 * i);
  for (std::size_t p = 0; p < level.pairs.size(); ++p) {
    const auto [i, j] = level.pairs[p];
    double difference[6], wrench[6] = {};
    for (int k = 0; k < 6; ++k) difference[k] = x[6 * i + k] - x[6 * j + k];
    level.stiffness[p].apply(difference, wrench);
    for (int k = 0; k < 6; ++k) {
      y[6 * i + k] += wrench[k];
      y[6 * j + k] -= wrench[k];
    }
  }
}

int Multigrid::solve(Eigen::VectorXd& x, double tolerance, int most) {
  Level& finest = levels_.front();
  const Eigen::Map<const Eigen::VectorXd> guess(finest.x.data(), x.size());
  residual_ = x;
  x.setZero();
  double before = 0.0, first = 0.0;
  for (int iteration = 0;; ++iteration) {
    std::copy_n(residual_.data(), residual_.size(), finest.b.data());
    cycle(0);
    const double now = dense::dot(residual_.data(), finest.x.data(), x.size());
    if (iteration == 0) first = now;
    if (!(now > tolerance * tolerance * first) || iteration == most) return iteration;
    if (iteration == 0) {
      direction_ = guess;
    } else {
      direction_ = guess + (now / before) * direction_;
    }
    multiply(finest, direction_.data(), product_.data());
    const double curvature = dense::dot(direction_.data(), product_.data(), x.size());
    if (!(curvature > 0.0)) return iteration;
    const double alpha = now / curvature;
    x += alpha * direction_;
    residual_ -= alpha * product_;
    before = now;
  }
}

}  // namespace pliant::cells
