#include "pliant/sketch/limb.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/sketch/tether.h"

namespace pliant {
namespace {

// Beside a part it joins the region's s may differ from that part's by this and by this much a
// length of the curve.
constexpr double kTetherSlack = 0.1, kTetherRate = 2.0;
constexpr int kJointPasses = 8;  // joints lie on facets: their depths are averaged along the stroke

Index count_of(const std::vector<Index>& items) { return static_cast<Index>(items.size()); }

/// Edges of the chosen triangles between local ids, each once.
std::vector<std::array<Index, 2>> local_edges(const Triangles& triangles, const Region& region,
                                              const std::vector<Index>& local, Index count) {
  std::vector<Index> offsets(count + 1, 0);
  const auto for_each_side = [&](auto&& visit) {
    for (Index t = 0; t < triangles.cols(); ++t) {
      if (region.of_triangle[t] != kRegionLabel) continue;
      for (int c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(local[triangles(c, t)], local[triangles((c + 1) % 3, t)]);
        visit(low, high);
      }
    }
  };
  for_each_side([&](Index low, Index) { ++offsets[low + 1]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<Index> others(offsets.back());
  std::vector<Index> next(offsets.begin(), offsets.end() - 1);
  for_each_side([&](Index low, Index high) { others[next[low]++] = high; });
  std::vector<std::array<Index, 2>> edges;
  edges.reserve(others.size() / 2);
  for (Index low = 0; low < count; ++low) {
    const auto first = others.begin() + offsets[low], last = others.begin() + offsets[low + 1];
    std::sort(first, last);
    std::for_each(first, std::unique(first, last), [&](Index high) { edges.push_back({low, high}); });
  }
  return edges;
}

}  // namespace

Limb::Limb(SeenShape&& seen, LaidStroke&& stroke, Region&& region)
    : seen_(std::move(seen)),
      stroke_(std::move(stroke)),
      region_(std::move(region)),
      points_(static_cast<Index>(seen_.view.cols())),
      pose_(SketchPose::rest(stroke_.curve)),
      angles_(2, 0.0) {
  collect_points();
  skin();
  place_virtual_vertices();
  prepare_smoother();
  bend_.assign(points_, 0.0);
  twist_.assign(points_, 0.0);
  scale_.assign(points_, 1.0);
}

void Limb::collect_points() {
  parts_.resize(region_.rigid_parts);
  moved_.assign(points_, false);
  for (Index p = 0; p < points_; ++p) {
    const Index label = region_.of_point[p];
    moved_[p] = label != kStaticLabel;
    if (label == kRegionLabel) free_.push_back(p);
    if (label >= kFirstRigidLabel) parts_[label - kFirstRigidLabel].points.push_back(p);
  }
  std::vector<bool> seen(points_, false);
  for (Index t = 0; t < seen_.triangles.cols(); ++t) {
    if (region_.of_triangle[t] != kRegionLabel) continue;
    for (const Index p : seen_.triangles.col(t)) {
      if (region_.of_point[p] != kRegionLabel && !seen[p]) pinned_.push_back(p);
      seen[p] = true;
    }
  }
}

void Limb::skin() {
  s_.assign(points_, 0.0);
  for (const Index p : free_) s_[p] = stroke_.curve.nearest(seen_.view.col(p).head<2>());
  sort_along_curve();
  for (const Index p : free_) raw_s_.push_back(s_[p]);
}

/// Along the curve neighbours lie close in memory, whatever the numbering of the mesh. To a
/// thousandth of the curve is enough.
void Limb::sort_along_curve() {
  constexpr Index slots = 1024;
  const auto slot = [&](Index p) { return static_cast<Index>(s_[p] * (slots - 1)); };
  std::vector<Index> next(slots + 1, 0), sorted(free_.size());
  for (const Index p : free_) ++next[slot(p) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const Index p : free_) sorted[next[slot(p)]++] = p;
  free_ = std::move(sorted);
}

/// Section 4.3: the virtual vertex of a rigid part is the centre of its boundary.
void Limb::place_virtual_vertices() {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Index p : pinned_) {
      if (region_.of_point[p] != kFirstRigidLabel + static_cast<Index>(k)) continue;
      center += seen_.view.col(p);
      ++count;
    }
    parts_[k].s = count > 0 ? stroke_.curve.nearest(center.head<2>() / count) : 1.0;
    for (const Index p : parts_[k].points) s_[p] = parts_[k].s;
  }
}

void Limb::prepare_smoother() {
  std::vector<Index> point_of_local = free_;
  point_of_local.insert(point_of_local.end(), pinned_.begin(), pinned_.end());
  std::vector<Index> local(points_, -1);
  for (Index i = 0; i < count_of(point_of_local); ++i) local[point_of_local[i]] = i;
  const auto edges = local_edges(seen_.triangles, region_, local, count_of(point_of_local));
  pins_.resize(pinned_.size());
  for (std::size_t i = 0; i < pinned_.size(); ++i) pins_[i] = s_[pinned_[i]];
  tether(seen_.view, point_of_local, edges, pins_, kTetherSlack, kTetherRate / stroke_.curve.length(), raw_s_);
  smoother_ = ParameterSmoother(seen_.view, point_of_local, count_of(free_), edges);
  raw_.resize(free_.size());
  solved_.resize(free_.size());
}

void Limb::set_smooth(bool smooth) {
  smooth_ = smooth;
  if (smooth) {
    for (std::size_t i = 0; i < pinned_.size(); ++i) pins_[i] = s_[pinned_[i]];
    solved_ = raw_s_;
    smoother_.solve(raw_s_, pins_, solved_);
  }
  const std::vector<double>& values = smooth ? solved_ : raw_s_;
  for (std::size_t i = 0; i < free_.size(); ++i) s_[free_[i]] = std::clamp(values[i], 0.0, 1.0);
  spread_to_added(s_);
}

template <class F, class G>
void Limb::spread(const F& f, double at_static, const G& rigid, std::vector<double>& values) {
  std::fill(values.begin(), values.end(), at_static);
  for (const Part& part : parts_) {
    const double value = rigid(part.s);
    for (const Index p : part.points) values[p] = value;
  }
  if (smooth_) {
    for (std::size_t i = 0; i < free_.size(); ++i) {
      raw_[i] = f(raw_s_[i]);
      solved_[i] = f(s_[free_[i]]);
    }
    for (std::size_t i = 0; i < pinned_.size(); ++i) pins_[i] = values[pinned_[i]];
    smoother_.solve(raw_, pins_, solved_, tolerance_);
    for (std::size_t i = 0; i < free_.size(); ++i) values[free_[i]] = solved_[i];
  } else {
    for (const Index p : free_) values[p] = f(s_[p]);
  }
  spread_to_added(values);
}

void Limb::spread_to_added(std::vector<double>& values) const {
  for (std::size_t i = 0; i < added_.size(); ++i) {
    values[points_ + i] = 0.5 * (values[added_[i][0]] + values[added_[i][1]]);
  }
}

void Limb::set_pose(const SketchPose& pose, double tolerance) {
  assert(has_joints() || (!pose.twists() && !pose.scales()));
  pose_ = pose;
  tolerance_ = tolerance;
  if (pose.bends()) {
    angles_ = bent(stroke_.curve, pose, 1.0).totals();
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      angles_[i] += pose.heading - stroke_.curve.totals()[i];  // eq. 5
    }
    const auto theta = [&](double s) { return linear_in(angles_, s); };
    spread(theta, 0.0, theta, bend_);
  } else {
    angles_.assign(2, 0.0);
    std::fill(bend_.begin(), bend_.end(), 0.0);
  }
  if (pose.twists()) {
    spread(pose.twist, 0.0, pose.twist, twist_);
  } else {
    std::fill(twist_.begin(), twist_.end(), 0.0);
  }
  if (pose.scales()) {
    // Rigid parts keep their size, and the region joins them.
    spread(pose.scale, 1.0, Profile::constant(1.0), scale_);
  } else {
    std::fill(scale_.begin(), scale_.end(), 1.0);
  }
}

Status Limb::find_joints() {
  if (has_joints()) return {};
  const Index nodes = stroke_.curve.size();
  std::vector<double> depths;
  for (Index i = 0; i < nodes; ++i) {
    const std::vector<Hit>& hits = stroke_.hits[i];
    if (hits.size() < 2) {
      return {ErrorCode::invalid_option,
              message({"reference meets the shape ", hits.empty() ? "nowhere" : "only once", " at pixel (",
                       stroke_.pixels(0, i), ", ", stroke_.pixels(1, i),
                       "); twist and scale need a front and a back hit at every pixel of it"})};
    }
    depths.push_back(0.5 * (hits[0].depth + hits[1].depth));
  }
  for (int pass = 0; pass < kJointPasses; ++pass) {
    const std::vector<double> before = depths;
    for (Index i = 1; i + 1 < nodes; ++i) {
      depths[i] = 0.25 * (before[i - 1] + 2.0 * before[i] + before[i + 1]);
    }
  }
  joints_.resize(3, nodes);
  for (Index i = 0; i < nodes; ++i) {
    joints_.col(i).head<2>() = seen_.camera.at_depth(stroke_.pixels.col(i), depths[i]);
    joints_(2, i) = depths[i];
  }
  return {};
}

/// Unit; the mean of the segments at a node, linear between.
Eigen::Vector3d Limb::tangent(double s) const {
  const Index last = static_cast<Index>(joints_.cols()) - 1;
  const double x = s * last;
  const Index i = std::clamp(static_cast<Index>(x), 0, last - 1);
  const auto at_node = [&](Index k) -> Eigen::Vector3d {
    return (joints_.col(std::min(k + 1, last)) - joints_.col(std::max(k - 1, 0))).normalized();
  };
  return ((1.0 - (x - i)) * at_node(i) + (x - i) * at_node(i + 1)).normalized();
}

/// Scaled and twisted about the joints.
Eigen::Vector3d Limb::twisted(const Eigen::Vector3d& view, const Parameters& at, double t) const {
  const Index last = static_cast<Index>(joints_.cols()) - 1;
  const double x = at.s * last;
  const Index i = std::clamp(static_cast<Index>(x), 0, last - 1);
  const Eigen::Vector3d joint = (1.0 - (x - i)) * joints_.col(i) + (x - i) * joints_.col(i + 1);
  // Eq. 7. View coordinates are left-handed, those of a reflected camera right-handed but twist
  // the other way: the angle's sign changes in both.
  return joint + (1.0 + t * (at.scale - 1.0)) * (Eigen::AngleAxisd(-t * at.twist, tangent(at.s)) * (view - joint));
}

class Limb::Placer {
 public:
  Placer(const Limb& limb, double t)
      : limb_(limb),
        t_(t),
        twists_(limb.pose_.twists() || limb.pose_.scales()),
        bends_(limb.pose_.bends()),
        target_(bent(limb.stroke_.curve, limb.pose_, t)) {}

  Eigen::Vector3d operator()(const Eigen::Vector3d& view, const Parameters& at) {
    Eigen::Vector3d v = twists_ ? limb_.twisted(view, at, t_) : view;
    if (!bends_) return v;
    if (at.s != s_ || at.bend != bend_) {  // alike all over a rigid part
      s_ = at.s;
      bend_ = at.bend;
      cosine_ = std::cos(t_ * bend_);
      sine_ = std::sin(t_ * bend_);
      from_ = limb_.stroke_.curve.point(s_);
      to_ = target_.point(s_);
    }
    const Eigen::Vector2d offset = v.head<2>() - from_;
    v.x() = to_.x() + cosine_ * offset.x() - sine_ * offset.y();  // eq. 6
    v.y() = to_.y() + sine_ * offset.x() + cosine_ * offset.y();
    return v;
  }

 private:
  const Limb& limb_;
  double t_;
  bool twists_, bends_;
  PlaneCurve target_;
  double s_ = -1.0, bend_ = 0.0, cosine_ = 1.0, sine_ = 0.0;
  Eigen::Vector2d from_ = Eigen::Vector2d::Zero(), to_ = Eigen::Vector2d::Zero();
};

void Limb::show(double t, Points& world, Index first) const {
  if (t == 0.0 || (!pose_.bends() && !pose_.twists() && !pose_.scales())) return;
  Placer place(*this, t);
  const Index total = static_cast<Index>(s_.size());
  for (Index p = first; p < total; ++p) {
    if (!moved_[p]) continue;
    const Parameters at{s_[p], bend_[p], twist_[p], scale_[p]};
    world.col(p) = seen_.camera.to_world(place(seen_.view.col(p), at));
  }
}

Limb::Parameters Limb::between(Index a, Index b) const {
  const auto mean = [&](const std::vector<double>& values) { return 0.5 * (values[a] + values[b]); };
  return {mean(s_), mean(bend_), mean(twist_), mean(scale_)};
}

Points Limb::middles(std::span<const std::array<Index, 2>> edges, double t) const {
  Placer place(*this, t);
  Points result(3, static_cast<Index>(edges.size()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    const Eigen::Vector3d view = 0.5 * (seen_.view.col(a) + seen_.view.col(b));
    result.col(static_cast<Index>(i)) = seen_.camera.to_world(place(view, between(a, b)));
  }
  return result;
}

void Limb::add(std::span<const std::array<Index, 2>> parents) {
  const Index first = static_cast<Index>(s_.size());
  seen_.view.conservativeResize(3, first + static_cast<Index>(parents.size()));
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const auto [a, b] = parents[i];
    const Parameters at = between(a, b);
    seen_.view.col(first + static_cast<Index>(i)) = 0.5 * (seen_.view.col(a) + seen_.view.col(b));
    moved_.push_back(moved_[a] || moved_[b]);
    s_.push_back(at.s);
    bend_.push_back(at.bend);
    twist_.push_back(at.twist);
    scale_.push_back(at.scale);
    added_.push_back(parents[i]);
  }
}

void Limb::drop_added() {
  added_.clear();
  seen_.view.conservativeResize(3, points_);
  moved_.resize(points_);
  for (std::vector<double>* values : {&s_, &bend_, &twist_, &scale_}) values->resize(points_);
}

}  // namespace pliant
