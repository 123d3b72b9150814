#include "pliant/sketch/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "pliant/sketch/plane_cut.h"
#include "pliant/sketch/stroke.h"

namespace pliant {
namespace {

constexpr double kBandPixels = 5.0;  // section 4.2.1
constexpr double kNearShare = 0.1;   // of the stroke: how far from its place a section may be,
constexpr double kWideShare = 0.35;  // and how far it may reach along the stroke
constexpr double kSlideStep = 0.05;
constexpr int kSlides = 8;
constexpr double kShrink = 1.4;  // of a section's length from one step to the next
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Index kUntouched = -1;

/// A plane that contains the view's direction.
struct ScreenLine {
  Eigen::Vector2d point;
  Eigen::Vector2d normal;  ///< unit, ahead
};

std::vector<double> distances(const SeenShape& shape, const ScreenLine& line) {
  std::vector<double> result(shape.view.cols());
  for (Index p = 0; p < shape.view.cols(); ++p) {
    result[p] = line.normal.dot(shape.view.col(p).head<2>() - line.point);
  }
  return result;
}

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

class RegionFinder {
 public:
  RegionFinder(const SeenShape& shape, const LaidStroke& stroke)
      : shape_(shape), stroke_(stroke), labels_(shape.triangles.cols(), kStaticLabel) {}

  Result<Region> find(std::span<const Polyline> partitions) {
    label_component();
    start_ = cut_limb(with_label(labels_, kRegionLabel), false, kStaticLabel);
    cut_limb(with_label(labels_, kRegionLabel), true, kFirstRigidLabel);
    for (std::size_t i = 0; i < partitions.size(); ++i) {
      if (!cut_partition(partitions[i])) {
        return Status(ErrorCode::invalid_option,
                      "partitions[" + std::to_string(i) + "] cuts nothing off the region; expected a line across it");
      }
    }
    Region region;
    region.start = start_;
    region.of_triangle = std::move(labels_);
    label_points(shape_.triangles, static_cast<Index>(shape_.view.cols()), region);
    if (std::find(region.of_point.begin(), region.of_point.end(), kRegionLabel) == region.of_point.end()) {
      return Status(ErrorCode::invalid_option,
                    "reference covers no vertex of the shape; expected a stroke over or along it");
    }
    return region;
  }

 private:
  double band() const { return kBandPixels * shape_.camera.pixel_size(stroke_.depth); }

  void label_component() {
    const std::vector<Index> component = connected_points(shape_.triangles, static_cast<Index>(shape_.view.cols()));
    const Index mine = component_of_stroke(component);
    for (Index t = 0; t < shape_.triangles.cols(); ++t) {
      if (component[shape_.triangles(0, t)] == mine) labels_[t] = kRegionLabel;
    }
  }

  /// The component most pixels of the stroke meet first, or else that of the point nearest to the
  /// stroke in the picture.
  Index component_of_stroke(const std::vector<Index>& component) const {
    std::vector<Index> met;
    for (const std::vector<Hit>& hits : stroke_.hits) {
      if (!hits.empty()) met.push_back(component[shape_.triangles(0, hits.front().triangle)]);
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
    for (const Index p : shape_.triangles.reshaped()) {
      const Eigen::Vector2d xy = shape_.view.col(p).head<2>();
      const double distance = (xy - stroke_.curve.point(stroke_.curve.nearest(xy))).squaredNorm();
      if (distance < nearest) nearest = distance, best = p;
    }
    return component[best];
  }

  /// Where the stroke is on the shape: the first hit there, else the point of the curve.
  Eigen::Vector3d anchor(double s) const {
    const auto node = static_cast<Index>(std::lround(s * (stroke_.curve.size() - 1)));
    const std::vector<Hit>& hits = stroke_.hits[node];
    const double depth = hits.empty() ? stroke_.depth : hits.front().depth;
    const Eigen::Vector2d xy = shape_.camera.at_depth(stroke_.pixels.col(node), depth);
    return {xy.x(), xy.y(), depth};
  }

  /// The loop nearest to the anchor, unless it belongs to another place along the stroke. -1: none.
  Index loop_at(const std::vector<CutLoop>& loops, double s) const {
    const Eigen::Vector3d from = anchor(s);
    double nearest = kInfinity;
    Index best = -1;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      Index at = 0;
      const double distance = (loops[l].crossings.colwise() - from).colwise().squaredNorm().minCoeff(&at);
      const double place = stroke_.curve.nearest(loops[l].crossings.col(at).head<2>());
      if (std::abs(place - s) <= kNearShare && distance < nearest) {
        nearest = distance;
        best = static_cast<Index>(l);
      }
    }
    return best;
  }

  /// Whether all of a loop lies near the place of the stroke where the plane is.
  bool is_section(const CutLoop& loop, double s) const {
    for (const auto& crossing : loop.crossings.colwise()) {
      if (std::abs(stroke_.curve.nearest(crossing.head<2>()) - s) > kWideShare) return false;
    }
    return true;
  }

  ScreenLine across(double s) const {
    const Polyline& nodes = stroke_.curve.nodes();
    const Index last = static_cast<Index>(nodes.cols()) - 1;
    // Over a few nodes: a stroke often begins and ends with a hook.
    const Index span = std::max<Index>(1, last / 20);
    const auto node = static_cast<Index>(std::lround(s * last));
    const Index first = std::min(std::max<Index>(0, node - span / 2), last - span);
    return {nodes.col(node), (nodes.col(first + span) - nodes.col(first)).normalized()};
  }

  /// What a plane across the stroke meets of the limb.
  struct Section {
    bool there = false;
    bool narrow = false;  ///< lies near its place along the stroke
    double length = 0.0;
  };

  Section section_at(const std::vector<Index>& part, double s) const {
    const std::vector<double> distance = distances(shape_, across(s));
    const PlaneCut cut(shape_.view, shape_.triangles, part, distance);
    const Index loop = loop_at(cut.loops(), s);
    if (loop < 0) return {};
    return {true, is_section(cut.loops()[loop], s), cut.loops()[loop].length};
  }

  /// How many steps the cut at the start moves on: past the last place where the section shrinks at
  /// once, since there the limb leaves the body, or its neighbours.
  int slide_start(const std::vector<Index>& part) const {
    int first = 0;
    Section before = section_at(part, 0.0);
    if (!before.there) return 0;
    bool narrow = before.narrow;
    for (int k = 1; k <= kSlides; ++k) {
      const Section section = section_at(part, k * kSlideStep);
      if (!section.there) continue;
      const bool leaves = before.length > kShrink * section.length;
      if (leaves || (section.narrow && !narrow)) {
        first = k;
        narrow = true;
      }
      before = section;
    }
    return first;
  }

  /// The end moves back only as long as its section is none.
  int slide_end(const std::vector<Index>& part) const {
    for (int k = 0; k <= kSlides; ++k) {
      const Section section = section_at(part, 1.0 - k * kSlideStep);
      if (section.narrow || (k == 0 && !section.there)) return k;
    }
    return 0;
  }

  /// Cuts `part` across the stroke near one of its ends and labels what lies beyond. Returns
  /// the place of the cut, or that of the end where no loop is there.
  double cut_limb(const std::vector<Index>& part, bool at_end, Index label) {
    const auto place = [&](int k) { return at_end ? 1.0 - k * kSlideStep : k * kSlideStep; };
    const double s = place(at_end ? slide_end(part) : slide_start(part));
    const std::vector<double> distance = distances(shape_, across(s));
    PlaneCut cut(shape_.view, shape_.triangles, part, distance);
    const Index first = loop_at(cut.loops(), s);
    if (first < 0) return place(0);
    cut.separate(first);
    const std::vector<CutSide> sides = cut.sides(band());
    const CutSide labelled = at_end ? CutSide::ahead : CutSide::behind;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (sides[i] == labelled) labels_[part[i]] = label;
    }
    return s;
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
    const std::vector<CutSide> sides = cut.sides(band());
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
    Index largest = kRegionLabel;
    for (const Index label : labels_) largest = std::max(largest, label);
    std::vector<bool> touched(shape_.view.cols(), false);
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (sides[i] != off) continue;
      for (const Index p : shape_.triangles.col(part[i])) touched[p] = true;
    }
    std::vector<bool> hangs_on(largest + 1, false);
    for (Index t = 0; t < shape_.triangles.cols(); ++t) {
      for (const Index p : shape_.triangles.col(t)) {
        if (touched[p]) hangs_on[labels_[t]] = true;
      }
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
  std::vector<Index> labels_;
  double start_ = 0.0;
};

}  // namespace

Result<LaidStroke> lay_stroke(const SeenShape& shape, const Polyline& pixels) {
  LaidStroke laid;
  laid.pixels = pixels;
  laid.hits = hits_through(shape.camera, shape.view, shape.triangles, pixels);
  const auto met =
      std::find_if(laid.hits.begin(), laid.hits.end(), [](const std::vector<Hit>& hits) { return !hits.empty(); });
  laid.depth = met != laid.hits.end() ? met->front().depth : shape.view.row(2).mean();
  if (!shape.camera.sees(laid.depth)) {
    return Status(ErrorCode::invalid_option, "camera.eye has the shape behind it; expected the shape in view");
  }
  Polyline nodes(2, pixels.cols());
  for (Index i = 0; i < pixels.cols(); ++i) {
    nodes.col(i) = shape.camera.at_depth(pixels.col(i), laid.depth);
  }
  laid.curve = PlaneCurve(std::move(nodes));
  return laid;
}

Result<Region> choose_region(const SeenShape& shape, const LaidStroke& stroke, std::span<const Polyline> partitions) {
  return RegionFinder(shape, stroke).find(partitions);
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
