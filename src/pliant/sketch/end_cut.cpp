#include "pliant/sketch/end_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant {
namespace {

constexpr double kBandPixels = 5.0;  // section 4.2.1
constexpr double kNearShare = 0.1;   // of the stroke: how far from its place a section may be,
constexpr double kWideShare = 0.35;  // and how far it may reach along the stroke
constexpr double kSlideStep = 0.05;
constexpr int kSlides = 8;
constexpr double kShrink = 1.4;  // of a section's length from one step to the next

}  // namespace

std::vector<double> distances(const SeenShape& shape, const ScreenLine& line) {
  std::vector<double> result(shape.view.cols());
  for (Index p = 0; p < shape.view.cols(); ++p) {
    result[p] = line.normal.dot(shape.view.col(p).head<2>() - line.point);
  }
  return result;
}

double cut_band(const SeenShape& shape, const LaidStroke& stroke) {
  return kBandPixels * shape.camera.pixel_size(stroke.depth);
}

/// Where the stroke is on the shape: the first hit there, else the point of the curve.
Eigen::Vector3d EndCutter::anchor(double s) const {
  const auto node = static_cast<Index>(std::lround(s * (stroke_.curve.size() - 1)));
  const std::vector<Hit>& hits = stroke_.hits[node];
  const double depth = hits.empty() ? stroke_.depth : hits.front().depth;
  const Eigen::Vector2d xy = shape_.camera.at_depth(stroke_.pixels.col(node), depth);
  return {xy.x(), xy.y(), depth};
}

/// The loop nearest to the anchor, unless it belongs to another place along the stroke. -1: none.
Index EndCutter::loop_at(const std::vector<CutLoop>& loops, double s) const {
  const Eigen::Vector3d from = anchor(s);
  double nearest = std::numeric_limits<double>::infinity();
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
bool EndCutter::is_section(const CutLoop& loop, double s) const {
  for (const auto& crossing : loop.crossings.colwise()) {
    if (std::abs(stroke_.curve.nearest(crossing.head<2>()) - s) > kWideShare) return false;
  }
  return true;
}

ScreenLine EndCutter::across(double s) const {
  const Polyline& nodes = stroke_.curve.nodes();
  const Index last = static_cast<Index>(nodes.cols()) - 1;
  // Over a few nodes: a stroke often begins and ends with a hook.
  const Index span = std::max<Index>(1, last / 20);
  const auto node = static_cast<Index>(std::lround(s * last));
  const Index first = std::min(std::max<Index>(0, node - span / 2), last - span);
  return {nodes.col(node), (nodes.col(first + span) - nodes.col(first)).normalized()};
}

EndCutter::Section EndCutter::section_at(double s) const {
  const std::vector<double> distance = distances(shape_, across(s));
  const PlaneCut cut(shape_.view, shape_.triangles, part_, distance);
  const Index loop = loop_at(cut.loops(), s);
  if (loop < 0) return {};
  return {true, is_section(cut.loops()[loop], s), cut.loops()[loop].length};
}

std::vector<CutSide> EndCutter::sides_of_plane(double s) const {
  const std::vector<double> distance = distances(shape_, across(s));
  PlaneCut cut(shape_.view, shape_.triangles, part_, distance);
  const Index first = loop_at(cut.loops(), s);
  if (first < 0) return {};
  cut.separate(first, true);
  return cut.sides_of_plane();
}

EndCut EndCutter::cut(double s) const {
  const std::vector<double> distance = distances(shape_, across(s));
  PlaneCut cut(shape_.view, shape_.triangles, part_, distance);
  const Index first = loop_at(cut.loops(), s);
  if (first < 0) return {};
  cut.separate(first, true);
  return {s, cut.sides(cut_band(shape_, stroke_))};
}

/// Past the last place where the section shrinks at once, since there the limb leaves the body, or
/// its neighbours.
EndCut EndCutter::limb_start() const {
  Section before = section_at(0.0);
  int first = 0;
  bool narrow = before.narrow;
  for (int k = 1; before.there && k <= kSlides; ++k) {
    const Section section = section_at(k * kSlideStep);
    if (!section.there) continue;
    const bool leaves = before.length > kShrink * section.length;
    if (leaves || (section.narrow && !narrow)) {
      first = k;
      narrow = true;
    }
    before = section;
  }
  return cut(first * kSlideStep);
}

/// The end moves back only as long as its section is none.
EndCut EndCutter::limb_end() const {
  for (int k = 0; k <= kSlides; ++k) {
    const Section section = section_at(1.0 - k * kSlideStep);
    if (section.narrow) return cut(1.0 - k * kSlideStep);
    if (k == 0 && !section.there) return {};
  }
  return cut(1.0);
}

}  // namespace pliant
