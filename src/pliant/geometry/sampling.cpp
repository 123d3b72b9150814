#include "pliant/geometry/sampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/canonical_order.h"
#include "pliant/geometry/normals.h"
#include "pliant/geometry/point_grid.h"

namespace pliant {
namespace {

/// The splitmix64 generator (Steele, Lea, Flood 2014): the same numbers on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// In [0, 1).
  double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((mixed ^ (mixed >> 31)) >> 11) * 0x1p-53;
  }

  Index below(Index limit) { return static_cast<Index>(uniform() * limit); }

 private:
  std::uint64_t state_;
};

/// What the nodes are chosen from, in random order.
struct Candidates {
  Points points;
  std::vector<Index> part;             ///< of each point, its component of the surface
  std::vector<double> area_fractions;  ///< of each part; together 1
};

/// `count` points over the triangles, one in each of as many equal parts of the area; none where
/// there is no area.
Candidates surface_candidates(const Shape& shape, const std::vector<Index>& order, Index count, Random& random) {
  const Points points = shape.points()(Eigen::all, order);
  const Triangles triangles = canonical_triangles(shape, order);
  const std::vector<Index> part_of =
      connected_components(triangles, triangles_of_points(triangles, static_cast<Index>(points.cols()))).of_triangle;
  const Points area_vectors = triangle_area_vectors(points, triangles);

  Candidates candidates;
  std::vector<double> area_up_to(part_of.size());
  double total = 0.0;
  for (std::size_t t = 0; t < part_of.size(); ++t) {
    const double area = area_vectors.col(static_cast<Index>(t)).norm() / 2;
    total += area;
    area_up_to[t] = total;
    candidates.area_fractions.resize(std::max<std::size_t>(candidates.area_fractions.size(), part_of[t] + 1), 0.0);
    candidates.area_fractions[part_of[t]] += area;
  }
  if (total <= Shape::kNoHeight * shape.diagonal() * shape.diagonal()) {
    return {};
  }
  for (double& fraction : candidates.area_fractions) {
    fraction /= total;
  }
  candidates.points.resize(3, count);
  candidates.part.resize(count);
  std::size_t t = 0;
  for (Index sample = 0; sample < count; ++sample) {
    const double place = (sample + random.uniform()) / count * total;
    while (t + 1 < part_of.size() && area_up_to[t] <= place) {
      ++t;
    }
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const auto corner = [&](int i) { return points.col(triangles(i, static_cast<Index>(t))); };
    candidates.points.col(sample) = corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0));
    candidates.part[sample] = part_of[t];
  }
  return candidates;
}

Candidates point_candidates(const Shape& shape, const std::vector<Index>& order) {
  return {shape.points()(Eigen::all, order), std::vector<Index>(order.size(), 0), {1.0}};
}

void shuffle(Candidates& candidates, Random& random) {
  for (Index i = static_cast<Index>(candidates.points.cols()) - 1; i > 0; --i) {
    const Index j = random.below(i + 1);
    candidates.points.col(i).swap(candidates.points.col(j));
    std::swap(candidates.part[i], candidates.part[j]);
  }
}

/// Goes through the points in order and removes all later ones within `radius` of each that is
/// still there. Returns those left, ascending: no two are closer than the radius, and none of the
/// others is farther from all of them.
std::vector<Index> remove_within(const Points& points, double radius) {
  const PointGrid grid(points, radius);
  std::vector<char> removed(points.cols(), 0);
  std::vector<Index> left;
  for (Index i = 0; i < points.cols(); ++i) {
    if (!removed[i]) {
      left.push_back(i);
      grid.for_each_near(points.col(i), [&](Index j, double) { removed[j] = 1; });
    }
  }
  return left;
}

struct Removal {
  std::vector<Index> left;
  double radius = 0.0;
};

/// The removal with the largest radius of a ladder that leaves at least `count` points.
Removal remove_to_at_least(const Points& points, Index count) {
  // From the spread of the points, which turning the scene does not change; an odd multiple, so
  // that no rung equals a distance in a regular layout.
  const Eigen::Vector3d center = points.rowwise().mean();
  const double spread = std::sqrt((points.colwise() - center).colwise().squaredNorm().mean());
  const double first_rung = 101.2345 * spread;
  const double ratio = 0.98;
  const int last_rung = 1250;  // 1e-9 of the spread
  const int guesses = 5;
  const auto rungs_to = [&](double factor) {
    return static_cast<int>(std::lround(std::log(factor) / std::log(ratio)));
  };

  Removal best;
  int too_large = -1;
  int small_enough = last_rung + 1;
  int rung = rungs_to(spread / std::sqrt(count) / first_rung);
  for (int round = 0; small_enough - too_large > 1; ++round) {
    if (round > guesses) {
      rung = std::midpoint(too_large, small_enough);
    }
    rung = std::clamp(rung, too_large + 1, small_enough - 1);
    const double radius = first_rung * std::pow(ratio, rung);
    std::vector<Index> left = remove_within(points, radius);
    const double surplus = static_cast<double>(left.size()) / count;
    if (surplus >= 1.0) {
      small_enough = rung;
      best = {std::move(left), radius};
    } else {
      too_large = rung;
    }
    // On a surface the number falls with the square of the radius.
    rung += rungs_to(std::sqrt(surplus)) + (surplus < 1.0);
  }
  if (best.left.empty()) {
    // Nearly all points coincide at this scale: there is nothing to spread.
    best.left.resize(count);
    std::iota(best.left.begin(), best.left.end(), 0);
    best.radius = first_rung * std::pow(ratio, last_rung);
  }
  return best;
}

/// Whether a part's fraction of the area is worth a whole node.
bool is_noticeable(double fraction, Index count) { return fraction * count >= 1.0 - 1e-9; }

/// Thins out chosen candidates, one of the closest pair at a time, the later one.
class Thinning {
 public:
  Thinning(const Candidates& candidates, std::vector<Index> chosen, double radius, Index count)
      : chosen_(std::move(chosen)),
        points_(candidates.points(Eigen::all, chosen_)),
        grid_(points_, 2 * radius),
        none_near_(2 * radius),
        gone_(chosen_.size(), 0),
        nearest_(chosen_.size()),
        left_of_part_(candidates.area_fractions.size(), 0),
        candidates_(candidates),
        count_(count) {
    for (const Index c : chosen_) {
      ++left_of_part_[candidates.part[c]];
    }
  }

  std::vector<Index> run() {
    for (Index i = 0; i < size(); ++i) {
      enter(i);
    }
    Index left = size();
    while (left > count_) {
      const auto [closeness, i] = closest_.top();
      closest_.pop();
      if (gone_[i] || closeness != -nearest_[i].first || is_last_of_its_part(i)) {
        continue;
      }
      remove(i);
      --left;
    }
    std::vector<Index> kept;
    for (Index i = 0; i < size(); ++i) {
      if (!gone_[i]) {
        kept.push_back(chosen_[i]);
      }
    }
    return kept;
  }

 private:
  Index size() const { return static_cast<Index>(chosen_.size()); }

  /// Finds the nearest other point that is left.
  void enter(Index i) {
    double squared = none_near_ * none_near_;
    Index neighbour = -1;
    grid_.for_each_near(points_.col(i), [&](Index j, double d) {
      if (j != i && !gone_[j] && d < squared) {
        squared = d;
        neighbour = j;
      }
    });
    // In units of the reach, so that distances round alike at every scale.
    nearest_[i] = {without_rounding_noise(squared / (none_near_ * none_near_)), neighbour};
    closest_.emplace(-nearest_[i].first, i);
  }

  bool is_last_of_its_part(Index i) const {
    const Index part = candidates_.part[chosen_[i]];
    return left_of_part_[part] == 1 && is_noticeable(candidates_.area_fractions[part], count_);
  }

  void remove(Index i) {
    gone_[i] = 1;
    --left_of_part_[candidates_.part[chosen_[i]]];
    grid_.for_each_near(points_.col(i), [&](Index j, double) {
      if (!gone_[j] && nearest_[j].second == i) {
        enter(j);
      }
    });
  }

  std::vector<Index> chosen_;
  Points points_;
  PointGrid grid_;
  double none_near_;
  std::vector<char> gone_;
  std::vector<std::pair<double, Index>> nearest_;  ///< squared distance over reach, neighbour
  std::vector<Index> left_of_part_;
  std::priority_queue<std::pair<double, Index>> closest_;  ///< minus squared distance, the later first
  const Candidates& candidates_;
  Index count_;
};

/// Adds the first candidate of every noticeable part that has none.
void add_missing_parts(const Candidates& candidates, Index count, std::vector<Index>& chosen) {
  std::vector<char> missing(candidates.area_fractions.size());
  for (std::size_t part = 0; part < missing.size(); ++part) {
    missing[part] = is_noticeable(candidates.area_fractions[part], count);
  }
  for (const Index c : chosen) {
    missing[candidates.part[c]] = 0;
  }
  for (Index c = 0; c < static_cast<Index>(candidates.part.size()); ++c) {
    char& is_missing = missing[candidates.part[c]];
    if (is_missing) {
      chosen.push_back(c);
      is_missing = 0;
    }
  }
  std::sort(chosen.begin(), chosen.end());
}

/// Enough for the radius to be felt everywhere, within bounds on memory.
Index dense_count(Index count) {
  const double factor = std::clamp(1e6 / count, 2.0, 30.0);
  return std::max<Index>(1000, static_cast<Index>(count * factor));
}

}  // namespace

Points sample_surface(const Shape& shape, Index count, std::uint64_t seed) {
  assert(1 <= count && count <= shape.points().cols());
  Random random(seed);
  const std::vector<Index> order = canonical_order(shape);
  Candidates candidates = surface_candidates(shape, order, dense_count(count), random);
  if (candidates.points.cols() == 0) {
    candidates = point_candidates(shape, order);
  }
  if (shape.diagonal() == 0.0) {
    return candidates.points;
  }
  shuffle(candidates, random);
  Removal removal = remove_to_at_least(candidates.points, count);
  add_missing_parts(candidates, count, removal.left);
  const std::vector<Index> kept = Thinning(candidates, std::move(removal.left), removal.radius, count).run();
  return candidates.points(Eigen::all, kept);
}

}  // namespace pliant
