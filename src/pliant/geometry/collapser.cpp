#include "pliant/geometry/collapser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/canonical_order.h"
#include "pliant/geometry/normals.h"

namespace pliant {
namespace {

/// Weight of the squared way a point moves beside its squared distances from the planes.
constexpr double kEvenness = 0.3;

/// A collapse that breaks a rule costs that many times more. Costs fall with the fourth power of
/// the spacing: what is six times finer than the rest goes in spite of the first two rules, and
/// what is ten times finer in spite of the last, so that no detail keeps points the layout needs
/// elsewhere, and every number of points can be reached.
constexpr double kThinTriangle = 1e3;
constexpr double kTurnedTriangle = 1e3;
constexpr double kChangedTopology = 1e4;

Eigen::Vector3d area_vector(const Eigen::Matrix3d& triangle) {
  return (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0));
}

/// Longest edge over shortest height.
double aspect_ratio(const Eigen::Matrix3d& triangle) {
  const double longest =
      std::max({(triangle.col(1) - triangle.col(0)).squaredNorm(), (triangle.col(2) - triangle.col(1)).squaredNorm(),
                (triangle.col(0) - triangle.col(2)).squaredNorm()});
  const double doubled_area = area_vector(triangle).norm();
  return doubled_area > 0.0 ? longest / doubled_area : std::numeric_limits<double>::infinity();
}

}  // namespace

Collapser::Collapser(Points points, Triangles triangles, double max_aspect_ratio)
    : max_aspect_ratio_(max_aspect_ratio),
      points_(std::move(points)),
      triangles_(std::move(triangles)),
      around_(points_.cols()),
      quadric_(points_.cols()),
      area_(points_.cols(), 0.0),
      stamp_(points_.cols(), 0),
      alive_(points_.cols(), 1),
      left_(static_cast<Index>(points_.cols())),
      ring_mark_(points_.cols(), 0),
      ring_place_(points_.cols()) {
  const Points area_vectors = triangle_area_vectors(points_, triangles_);
  for (Index t = 0; t < triangles_.cols(); ++t) {
    const double area = area_vectors.col(t).norm() / 2;
    for (const Index corner : triangles_.col(t)) {
      around_[corner].push_back(t);
      area_[corner] += area / 3;
      quadric_[corner].add_plane(area_vectors.col(t).normalized(), area);
    }
  }
  // Planes across the triangles along boundaries and other lines where not two triangles meet.
  const Incidence incidence = triangles_of_points(triangles_, left_);
  for_each_edge(triangles_, incidence, [&](Index a, Index b, std::span<const Index> sharing) {
    if (sharing.size() == 2) {
      return;
    }
    const Eigen::Vector3d edge = points_.col(b) - points_.col(a);
    for (const Index t : sharing) {
      const Eigen::Vector3d across = edge.cross(area_vectors.col(t)).normalized();
      quadric_[a].add_plane(across, edge.squaredNorm());
      quadric_[b].add_plane(across, edge.squaredNorm());
    }
  });
}

void Collapser::collect_ring(Index p, Ring& ring) {
  ring.clear();
  ++ring_number_;
  for (const Index t : around_[p]) {
    for (const Index corner : triangles_.col(t)) {
      if (corner == p) {
        continue;
      }
      if (!is_in_ring(corner)) {
        ring_mark_[corner] = ring_number_;
        ring_place_[corner] = static_cast<Index>(ring.size());
        ring.push_back({corner, 0});
      }
      ++ring[ring_place_[corner]].triangles;
    }
  }
}

Eigen::Matrix3d Collapser::corners(Index t) const {
  Eigen::Matrix3d result;
  for (int corner = 0; corner < 3; ++corner) {
    result.col(corner) = points_.col(triangles_(corner, t));
  }
  return result;
}

void Collapser::collect_choices(Index p) {
  choices_.clear();
  collect_ring(p, ring_);
  for (const Neighbour& n : ring_) {
    choices_.emplace_back(cost(p, n.point), n.point);
  }
  if (ring_.empty()) {
    choices_.emplace_back(cost(p, kNothing), kNothing);
  }
}

/// Enters a point at its cost without penalties: what breaks a rule is only asked when it is due.
void Collapser::push(Index p) {
  collect_choices(p);
  const auto [price, onto] = *std::min_element(choices_.begin(), choices_.end());
  queue_.push({price, p, onto, ++stamp_[p]});
}

/// With penalties.
Collapser::Collapse Collapser::cheapest(Index p) {
  collect_choices(p);
  thinnest_before_ = 0.0;
  for (const Index t : around_[p]) {
    thinnest_before_ = std::max(thinnest_before_, aspect_ratio(corners(t)));
  }
  Collapse best{std::numeric_limits<double>::infinity(), p, std::min_element(choices_.begin(), choices_.end())->second,
                stamp_[p]};
  // In ascending order; mostly one of the first two decides.
  for (auto next = choices_.begin(); next != choices_.end(); ++next) {
    std::iter_swap(next, std::min_element(next, choices_.end()));
    const auto [price, onto] = *next;
    if (price >= best.cost) {
      break;
    }
    const double penalised = price * penalty(p, onto);
    if (penalised < best.cost) {
      best.cost = penalised;
      best.onto = onto;
    }
  }
  return best;
}

/// Equal up to rounding means equal: the lower rank decides.
double Collapser::cost(Index p, Index onto) const {
  if (onto == kNothing) {
    // As for a neighbour as far away as the surface it stands for is wide.
    return without_rounding_noise(kEvenness * area_[p] * area_[p]);
  }
  const Eigen::Vector3d way = points_.col(onto) - points_.col(p);
  return without_rounding_noise(quadric_[p].at(way) + quadric_[onto].c + kEvenness * area_[p] * way.squaredNorm());
}

double Collapser::penalty(Index p, Index onto) const {
  if (onto == kNothing || is_tetrahedron(p, onto)) {
    return 1.0;
  }
  return (keeps_lines(onto) && keeps_topology(p, onto) ? 1.0 : kChangedTopology) * shape_penalty(p, onto);
}

/// The last four triangles of a closed component may go: first to one seen from both sides.
bool Collapser::is_tetrahedron(Index p, Index onto) const {
  if (around_[p].size() != 3 || around_[onto].size() != 3) {
    return false;
  }
  std::vector<Index> used;
  for (const Index end : {p, onto}) {
    for (const Index t : around_[end]) {
      used.insert(used.end(), triangles_.col(t).begin(), triangles_.col(t).end());
    }
  }
  std::sort(used.begin(), used.end());
  return std::unique(used.begin(), used.end()) - used.begin() == 4;
}

/// Points of lines where not two triangles meet only move along them, ends and crossings not at
/// all.
bool Collapser::keeps_lines(Index onto) const {
  int line_edges = 0;
  bool along_line = false;
  for (const Neighbour& n : ring_) {
    line_edges += n.triangles != 2;
    along_line |= n.point == onto && n.triangles != 2;
  }
  return line_edges == 0 || (line_edges == 2 && along_line);
}

/// The link condition: points next to both ends must be opposite the edge in one of its triangles,
/// and no triangle may land on another.
bool Collapser::keeps_topology(Index p, Index onto) const {
  const auto is_opposite = [&](Index point) {
    return std::any_of(around_[p].begin(), around_[p].end(),
                       [&](Index t) { return contains(t, onto) && contains(t, point); });
  };
  for (const Index other : around_[onto]) {
    if (contains(other, p)) {
      continue;
    }
    int next_to_both = 0;
    for (const Index corner : triangles_.col(other)) {
      if (corner != onto && is_in_ring(corner)) {
        ++next_to_both;
        if (!is_opposite(corner)) {
          return false;
        }
      }
    }
    const auto lands_on_other = [&](Index t) {
      return !contains(t, onto) && std::all_of(triangles_.col(t).begin(), triangles_.col(t).end(),
                                               [&](Index corner) { return corner == p || contains(other, corner); });
    };
    if (next_to_both == 2 && std::any_of(around_[p].begin(), around_[p].end(), lands_on_other)) {
      return false;
    }
  }
  return true;
}

/// For triangles that turn over, or become thinner than allowed and than the worst one is already.
double Collapser::shape_penalty(Index p, Index onto) const {
  const double least_cosine = 0.2;
  const double no_normal = 1e8;        // an aspect ratio beyond which it is rounding
  const double rounding = 1.0 + 1e-9;  // regular layouts meet round limits exactly
  double thinnest = 0.0;
  bool turned = false;
  for (const Index t : around_[p]) {
    if (contains(t, onto)) {
      continue;
    }
    const Eigen::Matrix3d before = corners(t);
    Eigen::Matrix3d after = before;
    for (int corner = 0; corner < 3; ++corner) {
      if (triangles_(corner, t) == p) {
        after.col(corner) = points_.col(onto);
      }
    }
    const double aspect = aspect_ratio(after);
    thinnest = std::max(thinnest, aspect);
    const Eigen::Vector3d normal = area_vector(before);
    const Eigen::Vector3d new_normal = area_vector(after);
    turned |= aspect > no_normal || normal.dot(new_normal) < least_cosine * normal.norm() * new_normal.norm();
  }
  return (turned ? kTurnedTriangle : 1.0) *
         (thinnest > std::max(max_aspect_ratio_, thinnest_before_) * rounding ? kThinTriangle : 1.0);
}

void Collapser::perform(const Collapse& collapse) {
  const auto [price, p, onto, stamp] = collapse;
  alive_[p] = 0;
  --left_;
  if (onto == kNothing) {
    return;
  }
  quadric_[onto].add(quadric_[p].about(points_.col(onto) - points_.col(p)));
  area_[onto] += area_[p];
  for (const Index t : around_[p]) {
    if (contains(t, onto)) {
      for (const Index corner : triangles_.col(t)) {
        if (corner != p) {
          std::erase(around_[corner], t);
        }
      }
    } else {
      std::replace(triangles_.col(t).begin(), triangles_.col(t).end(), p, onto);
      around_[onto].push_back(t);
    }
  }
  around_[p].clear();
}

void Collapser::run(Index target) {
  for (Index p = 0; p < left_; ++p) {
    push(p);
  }
  Ring affected;
  while (left_ > target) {
    const Collapse collapse = queue_.top();
    queue_.pop();
    const Index p = collapse.point;
    if (!alive_[p] || collapse.stamp != stamp_[p]) {
      continue;
    }
    const Collapse now = cheapest(p);
    if (now.cost > collapse.cost) {
      queue_.push(now);
      continue;
    }
    collect_ring(p, affected);  // holds the point it goes to
    perform(now);
    for (const Neighbour& n : affected) {
      push(n.point);
    }
  }
}

}  // namespace pliant
