#include "pliant/sketch/region.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/edge_distance.h"
#include "pliant/sketch/end_cut.h"
#include "pliant/sketch/plane_cut.h"

namespace pliant {
namespace {

constexpr double kLeastGap = 0.4;      // of the stroke, between the static part and the end's
constexpr double kLeastReach = 0.25;   // of the stroke, that what moves has to reach along it
constexpr double kClearlyMore = 0.05;  // of the area of the component
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Index kUntouched = -1;

std::vector<Index> with_label(const std::vector<Index>& labels, Index label) {
  std::vector<Index> part;
  for (Index t = 0; t < static_cast<Index>(labels.size()); ++t) {
    if (labels[t] == label) part.push_back(t);
  }
  return part;
}

/// Labels the points by their triangles and numbers the rigid parts without gaps.
void label_points(const Triangles& triangles, Index points, Region& region) {
  std::vector<Index> number;  // by label
  for (Index& label : region.of_triangle) {
    if (label < kFirstRigidLabel) continue;
    if (label >= static_cast<Index>(number.size())) number.resize(label + 1, kUntouched);
    if (number[label] == kUntouched) number[label] = kFirstRigidLabel + region.rigid_parts++;
    label = number[label];
  }
  region.of_point.assign(points, kUntouched);
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Index label = region.of_triangle[t];
    for (const Index p : triangles.col(t)) {
      Index& known = region.of_point[p];
      const bool wins = known == kUntouched || label == kStaticLabel || (known == kRegionLabel && label > kRegionLabel);
      if (wins && known != kStaticLabel) known = label;
    }
  }
  for (Index& label : region.of_point) label = std::max(label, kStaticLabel);
}

/// A bit a label.
using LabelSet = std::uint8_t;
constexpr LabelSet kStaticBit = 1u << kStaticLabel, kRigidBit = 1u << kFirstRigidLabel;
bool is_one_label(LabelSet around) { return (around & (around - 1)) == 0; }
bool at_static(LabelSet around) { return (around & kStaticBit) != 0 && !is_one_label(around); }
bool at_rigid(LabelSet around) { return (around & kRigidBit) != 0 && !is_one_label(around); }

double area_of(const SeenShape& shape, Index triangle) {
  const auto& corners = shape.triangles.col(triangle);
  const Eigen::Vector3d a = shape.view.col(corners[0]);
  return 0.5 * (shape.view.col(corners[1]) - a).cross(shape.view.col(corners[2]) - a).norm();
}

/// A point of the component, of those that hang together, that the stroke lies on.
Index component_of_stroke(const SeenShape& shape, const LaidStroke& stroke, const std::vector<Index>& component) {
  std::vector<Index> met;
  for (const std::vector<Hit>& hits : stroke.hits) {
    if (!hits.empty()) met.push_back(component[shape.triangles(0, hits.front().triangle)]);
  }
  if (!met.empty()) {
    std::sort(met.begin(), met.end());
    Index best = met.front();
    std::ptrdiff_t most = 0;
    for (auto first = met.begin(); first != met.end();) {
      const auto last = std::upper_bound(first, met.end(), *first);
      if (last - first > most) most = last - first, best = *first;
      first = last;
    }
    return best;
  }
  double nearest = kInfinity;
  Index best = 0;
  std::vector<bool> seen(shape.view.cols(), false);
  for (const Index p : shape.triangles.reshaped()) {
    if (seen[p]) continue;
    seen[p] = true;
    const Eigen::Vector2d xy = shape.view.col(p).head<2>();
    const double distance = (xy - stroke.curve.point(stroke.curve.nearest(xy))).squaredNorm();
    if (distance < nearest) nearest = distance, best = p;
  }
  return component[best];
}

class RegionFinder {
 public:
  RegionFinder(const SeenShape& shape, const LaidStroke& stroke, std::span<const Index> component)
      : shape_(shape), stroke_(stroke), component_(component), labels_(shape.triangles.cols(), kStaticLabel) {}

  Result<Region> find(std::span<const Polyline> partitions) {
    cut_ends();
    keep_ends_apart();
    for (std::size_t i = 0; i < partitions.size(); ++i) {
      if (!cut_partition(partitions[i])) {
        return Status(ErrorCode::invalid_option,
                      message({"partitions[", i, "] cuts nothing off the region; expected a line across it"}));
      }
    }
    return checked_region();
  }

 private:
  /// How far along the stroke what moves reaches, or enough: the nearest places of all points take
  /// their time.
  double reach_of(const Region& region) const {
    if (region.rigid_parts > 0) return 1.0;
    double reach = 0.0;
    for (Index p = 0; p < shape_.view.cols() && reach < start_ + kLeastReach; ++p) {
      if (region.of_point[p] == kRegionLabel) {
        reach = std::max(reach, stroke_.curve.nearest(shape_.view.col(p).head<2>()));
      }
    }
    return reach;
  }

  Result<Region> checked_region() {
    Region region;
    region.start = start_;
    region.of_triangle = std::move(labels_);
    label_points(shape_.triangles, static_cast<Index>(shape_.view.cols()), region);
    if (std::find(region.of_point.begin(), region.of_point.end(), kRegionLabel) == region.of_point.end()) {
      return Status(ErrorCode::invalid_option,
                    "reference covers no vertex of the shape; expected a stroke over or along it");
    }
    assert(!torn_edge(shape_.triangles, region.of_point));
    const double reach = reach_of(region);
    if (reach < start_ + kLeastReach) {
      return Status(ErrorCode::invalid_option, message({"reference leaves the shape after ", std::lround(100.0 * reach),
                                                        " % of its length; expected a stroke along a limb"}));
    }
    return region;
  }

  void cut_ends() {
    const EndCutter cutter(shape_, stroke_, component_);
    const EndCut start = cutter.limb_start(), end = cutter.limb_end();
    start_ = start.s;
    for (std::size_t i = 0; i < component_.size(); ++i) {
      const bool before = !start.sides.empty() && start.sides[i] == CutSide::behind;
      const bool beyond = !end.sides.empty() && end.sides[i] == CutSide::ahead;
      labels_[component_[i]] = before == beyond ? kRegionLabel : (before ? kStaticLabel : kFirstRigidLabel);
    }
  }

  /// Where planes cross, or a ring is cut by one of them only, static and rigid part would meet: what
  /// of the rigid one is nearer to the static one than the gap joins the region.
  void keep_ends_apart() {
    const double gap = kLeastGap * stroke_.curve.length();
    const std::vector<LabelSet> around = labels_around_points();
    if (!borders_are_within(gap, around)) return;
    const std::vector<double> distance = distances_from_static(gap, around);
    for (const Index t : component_) {
      if (labels_[t] != kFirstRigidLabel) continue;
      for (const Index p : shape_.triangles.col(t)) {
        if (distance[p] < kInfinity) labels_[t] = kRegionLabel;
      }
    }
  }

  /// Of the triangles around every point of the component, before partitions.
  std::vector<LabelSet> labels_around_points() const {
    std::vector<LabelSet> around(shape_.view.cols(), LabelSet{0});
    for (const Index t : component_) {
      const auto label = static_cast<LabelSet>(1u << labels_[t]);
      for (const Index p : shape_.triangles.col(t)) around[p] |= label;
    }
    return around;
  }

  /// Whether a path between static and rigid part may be as short as `reach`: no path is shorter than
  /// the way between the boxes of what lies beside the one and at the other.
  bool borders_are_within(double reach, const std::vector<LabelSet>& around) const {
    Eigen::AlignedBox3d static_border, rigid_border;
    for (const Index t : component_) {
      const auto& corners = shape_.triangles.col(t);
      const LabelSet a = around[corners[0]], b = around[corners[1]], c = around[corners[2]];
      if (a == b && a == c && is_one_label(a)) continue;  // as most are
      const bool beside = at_static(a) || at_static(b) || at_static(c);
      for (const Index p : corners) {
        if (beside) static_border.extend(shape_.view.col(p));
        if (at_rigid(around[p])) rigid_border.extend(shape_.view.col(p));
      }
    }
    if (static_border.isEmpty() || rigid_border.isEmpty()) return false;
    return static_border.exteriorDistance(rigid_border) <= reach;
  }

  /// Of the points beside the static part along edges, as far as `reach`, and 0 over one edge
  /// however long it is; infinite beyond.
  std::vector<double> distances_from_static(double reach, const std::vector<LabelSet>& around) const {
    const Triangles& triangles = shape_.triangles;
    const auto points = static_cast<Index>(shape_.view.cols());
    std::vector<double> distance(points, kInfinity);
    for (Index p = 0; p < points; ++p) {
      if (at_static(around[p])) distance[p] = 0.0;
    }
    spread_distances(shape_.view, triangles, triangles_of_points(triangles, points), reach, distance);
    for (const Index t : component_) {
      const auto& corners = triangles.col(t);
      if (std::none_of(corners.begin(), corners.end(), [&](Index p) { return at_static(around[p]); })) continue;
      for (const Index p : corners) distance[p] = 0.0;
    }
    return distance;
  }

  /// The corners of the triangles for which chosen(t) holds, as a flag a point.
  template <class Chosen>
  std::vector<bool> corners_of(const Chosen& chosen) const {
    std::vector<bool> corners(shape_.view.cols(), false);
    for (Index t = 0; t < shape_.triangles.cols(); ++t) {
      if (!chosen(t)) continue;
      for (const Index p : shape_.triangles.col(t)) corners[p] = true;
    }
    return corners;
  }

  bool touches(Index triangle, const std::vector<bool>& points) const {
    const auto& corners = shape_.triangles.col(triangle);
    return points[corners[0]] || points[corners[1]] || points[corners[2]];
  }

  /// Of the loops that run under the drawn line, the one nearest to the eye; -1: none.
  Index loop_under(const std::vector<CutLoop>& loops, const Polyline& ends) const {
    const Eigen::Vector2d a = ends.col(0);
    const Eigen::Vector2d along = ends.col(1) - a;
    double nearest = kInfinity;
    Index best = -1;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      for (const auto& crossing : loops[l].crossings.colwise()) {
        if (!shape_.camera.sees(crossing.z())) continue;
        const double place = (shape_.camera.pixel(crossing) - a).dot(along) / along.squaredNorm();
        if (place < 0.0 || place > 1.0 || crossing.z() >= nearest) continue;
        nearest = crossing.z();
        best = static_cast<Index>(l);
      }
    }
    return best;
  }

  bool cut_partition(const Polyline& line) {
    Polyline ends(2, 2);
    ends << line.col(0), line.col(line.cols() - 1);
    const Eigen::Vector2d a = shape_.camera.at_depth(ends.col(0), stroke_.depth);
    const Eigen::Vector2d along = shape_.camera.at_depth(ends.col(1), stroke_.depth) - a;
    const ScreenLine plane{a, Eigen::Vector2d(-along.y(), along.x()).normalized()};
    const std::vector<double> distance = distances(shape_, plane);
    const std::vector<Index> part = with_label(labels_, kRegionLabel);
    PlaneCut cut(shape_.view, shape_.triangles, part, distance);
    const Index first = loop_under(cut.loops(), ends);
    if (first < 0) return false;
    cut.separate(first);
    const std::vector<CutSide> sides = cut.sides(cut_band(shape_, stroke_));
    const CutSide off = far_side(part, sides);
    cut_off(part, sides, off);
    return true;
  }

  /// The side that fewer nodes of the stroke are nearest to.
  CutSide far_side(const std::vector<Index>& part, const std::vector<CutSide>& sides) const {
    int votes = 0;
    for (const auto& node : stroke_.curve.nodes().colwise()) {
      const Eigen::Vector3d at(node.x(), node.y(), stroke_.depth);
      double nearest = kInfinity;
      CutSide side = CutSide::outside;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const double distance = (shape_.view.col(shape_.triangles(0, part[i])) - at).squaredNorm();
        if (sides[i] != CutSide::outside && distance < nearest) nearest = distance, side = sides[i];
      }
      votes += side == CutSide::ahead ? 1 : -1;
    }
    return votes > 0 ? CutSide::behind : CutSide::ahead;
  }

  /// What is cut off hangs on the static part and joins it, or becomes a rigid part together with
  /// those that hang on it.
  void cut_off(const std::vector<Index>& part, const std::vector<CutSide>& sides, CutSide off) {
    const Index largest = std::max(kRegionLabel, *std::max_element(labels_.begin(), labels_.end()));
    std::vector<bool> is_off(labels_.size(), false);
    for (std::size_t i = 0; i < part.size(); ++i) is_off[part[i]] = sides[i] == off;
    // Also over one edge: what is between would be torn.
    const std::vector<bool> own = corners_of([&](Index t) { return is_off[t]; });
    const std::vector<bool> near = corners_of([&](Index t) { return touches(t, own); });
    std::vector<bool> hangs_on(largest + 1, false);
    for (Index t = 0; t < shape_.triangles.cols(); ++t) {
      if (touches(t, near)) hangs_on[labels_[t]] = true;
    }
    const Index label = hangs_on[kStaticLabel] ? kStaticLabel : largest + 1;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (sides[i] == off) labels_[part[i]] = label;
    }
    for (Index& other : labels_) {
      if (other > kRegionLabel && other <= largest && hangs_on[other]) other = label;
    }
  }

  const SeenShape& shape_;
  const LaidStroke& stroke_;
  std::span<const Index> component_;
  std::vector<Index> labels_;
  double start_ = 0.0;
};

}  // namespace

std::vector<Index> component_under(const SeenShape& shape, const LaidStroke& stroke) {
  const std::vector<Index> component = connected_points(shape.triangles, static_cast<Index>(shape.view.cols()));
  const Index mine = component_of_stroke(shape, stroke, component);
  std::vector<Index> triangles;
  triangles.reserve(shape.triangles.cols());
  for (Index t = 0; t < shape.triangles.cols(); ++t) {
    if (component[shape.triangles(0, t)] == mine) triangles.push_back(t);
  }
  return triangles;
}

bool more_beyond_end(const SeenShape& shape, const LaidStroke& stroke, std::span<const Index> component) {
  const EndCutter cutter(shape, stroke, component);
  const std::vector<CutSide> start = cutter.sides_of_plane(0.0), end = cutter.sides_of_plane(1.0);
  double more = 0.0, all = 0.0;
  for (std::size_t i = 0; i < component.size(); ++i) {
    const double area = area_of(shape, component[i]);
    all += area;
    if (!end.empty() && end[i] == CutSide::ahead) more += area;
    if (!start.empty() && start[i] == CutSide::behind) more -= area;
  }
  return more > kClearlyMore * all;
}

bool runs_to_static(const SeenShape& shape, const PlaneCurve& curve, const Region& region) {
  double place[2] = {0.0, 0.0};  // sums over points of the static part beside the region, and of it
  Index count[2] = {0, 0};
  for (Index t = 0; t < shape.triangles.cols(); ++t) {
    if (region.of_triangle[t] != kRegionLabel) continue;
    for (const Index p : shape.triangles.col(t)) {
      const Index label = region.of_point[p];
      if (label > kRegionLabel) continue;
      place[label] += curve.nearest(shape.view.col(p).head<2>());
      ++count[label];
    }
  }
  return count[0] > 0 && count[1] > 0 && place[0] * count[1] > place[1] * count[0];
}

Result<Region> choose_region(const SeenShape& shape, const LaidStroke& stroke, std::span<const Index> component,
                             std::span<const Polyline> partitions) {
  return RegionFinder(shape, stroke, component).find(partitions);
}

std::optional<std::array<Index, 2>> torn_edge(const Triangles& triangles, std::span<const Index> of_point) {
  for (Index t = 0; t < triangles.cols(); ++t) {
    for (const Index a : triangles.col(t)) {
      for (const Index b : triangles.col(t)) {
        if (of_point[a] > of_point[b] && of_point[a] != kRegionLabel && of_point[b] != kRegionLabel) return {{a, b}};
      }
    }
  }
  return std::nullopt;
}

Region region_from_labels(const Triangles& triangles, std::span<const Index> of_point) {
  Region region;
  region.of_point.assign(of_point.begin(), of_point.end());
  region.of_triangle.resize(triangles.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    // A triangle with corners of two kinds lies in the region: that is where it deforms.
    const Index a = of_point[triangles(0, t)];
    const bool all_same = a == of_point[triangles(1, t)] && a == of_point[triangles(2, t)];
    region.of_triangle[t] = all_same ? a : kRegionLabel;
  }
  for (const Index label : of_point) {
    region.rigid_parts = std::max(region.rigid_parts, label - kRegionLabel);
  }
  return region;
}

}  // namespace pliant
