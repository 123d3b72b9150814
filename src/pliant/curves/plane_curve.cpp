#include "pliant/curves/plane_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace pliant {
namespace {

constexpr Index kBlockSize = 8;  // segments
constexpr int kMaxRounds = 30;
constexpr double kEqualSteps = 1e-7;

/// Length of the line up to each of its points.
std::vector<double> lengths_along(const Polyline& line) {
  std::vector<double> lengths(line.cols(), 0.0);
  for (Index i = 1; i < line.cols(); ++i) {
    lengths[i] = lengths[i - 1] + (line.col(i) - line.col(i - 1)).norm();
  }
  return lengths;
}

/// Index and t of the segment of ascending `knots` in which x lies, walking on from `k`.
double locate(const std::vector<double>& knots, double x, std::size_t& k) {
  while (k + 2 < knots.size() && knots[k + 1] < x) ++k;
  const double width = knots[k + 1] - knots[k];
  return width > 0.0 ? std::clamp((x - knots[k]) / width, 0.0, 1.0) : 0.0;
}

std::vector<double> even_places(double length, Index nodes) {
  std::vector<double> places(nodes);
  for (Index i = 0; i < nodes; ++i) places[i] = length * i / (nodes - 1);
  return places;
}

/// The points at ascending places along the line.
Polyline at_places(const Polyline& line, const std::vector<double>& along, const std::vector<double>& places) {
  Polyline result(2, static_cast<Index>(places.size()));
  std::size_t k = 0;
  for (Index i = 0; i < result.cols(); ++i) {
    const double t = locate(along, places[i], k);
    const auto at = static_cast<Index>(k);
    result.col(i) = (1.0 - t) * line.col(at) + t * line.col(at + 1);
  }
  return result;
}

}  // namespace

double angle_between(double a, double b) {
  const double angle = std::remainder(a - b, 2 * std::numbers::pi);
  return angle <= -std::numbers::pi ? std::numbers::pi : angle;
}

double linear_in(const std::vector<double>& values, double s) {
  const Index last = static_cast<Index>(values.size()) - 1;
  const double x = s * last;
  const Index i = std::clamp(static_cast<Index>(x), 0, last - 1);
  return values[i] + (values[i + 1] - values[i]) * (x - i);
}

double length_of(const Polyline& line) { return lengths_along(line).back(); }

Polyline sampled(const Polyline& line, Index nodes) {
  assert(line.cols() >= 2 && nodes >= 2);
  const std::vector<double> along = lengths_along(line);
  return at_places(line, along, even_places(along.back(), nodes));
}

Polyline resampled(const Polyline& line, Index nodes) {
  assert(line.cols() >= 2 && nodes >= 2);
  const std::vector<double> along = lengths_along(line);
  std::vector<double> places = even_places(along.back(), nodes);
  Polyline result;
  // Chords across a bend are shorter than the line: places move until all are equal.
  for (int round = 0; round < kMaxRounds; ++round) {
    result = at_places(line, along, places);
    const std::vector<double> chords = lengths_along(result);
    const double step = chords.back() / (nodes - 1);
    double worst = 0.0;
    std::vector<double> moved = places;
    std::size_t k = 0;
    for (Index i = 1; i + 1 < nodes; ++i) {
      worst = std::max(worst, std::abs(chords[i] - step * i));
      const double t = locate(chords, step * i, k);
      moved[i] = (1.0 - t) * places[k] + t * places[k + 1];
    }
    if (worst <= kEqualSteps * step) break;
    places = std::move(moved);
  }
  return result;
}

PlaneCurve::PlaneCurve(Polyline nodes) : nodes_(std::move(nodes)) {
  assert(nodes_.cols() >= 3);
  step_ = length_of(nodes_) / static_cast<double>(nodes_.cols() - 1);
  double before = 0.0;
  for (Index i = 0; i + 1 < nodes_.cols(); ++i) {
    const Eigen::Vector2d segment = nodes_.col(i + 1) - nodes_.col(i);
    const double direction = std::atan2(segment.y(), segment.x());
    if (i == 0) {
      heading_ = direction;
    } else {
      turns_.push_back(angle_between(direction, before));
    }
    before = direction;
  }
  derive();
}

PlaneCurve::PlaneCurve(const Eigen::Vector2d& start, double heading, std::vector<double> turns, double step)
    : nodes_(2, static_cast<Index>(turns.size()) + 2), heading_(heading), step_(step), turns_(std::move(turns)) {
  nodes_.col(0) = start;
  double direction = heading;
  for (Index i = 1; i < nodes_.cols(); ++i) {
    if (i > 1) direction += turns_[i - 2];
    nodes_.col(i) = nodes_.col(i - 1) + step * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }
  derive();
}

void PlaneCurve::derive() {
  const Index n = size();
  totals_.assign(2 * n - 1, 0.0);
  totals_[0] = -0.5 * turns_.front();
  // Eq. 1; with the middles between, eq. 2: b(2 alpha) and b(2 alpha - 1) are the halves of a
  // segment.
  for (Index i = 1; i + 1 < n; ++i) {
    totals_[2 * i] = totals_[2 * i - 1] + 0.5 * turns_[i - 1];
    totals_[2 * i + 1] = totals_[2 * i] + 0.5 * turns_[i - 1];
  }
  totals_[2 * n - 2] = totals_[2 * n - 3] + 0.5 * turns_.back();

  blocks_.clear();
  for (Index first = 0; first + 1 < n; first += kBlockSize) {
    const Index count = std::min(kBlockSize + 1, n - first);
    const auto part = nodes_.middleCols(first, count);
    blocks_.push_back({part.rowwise().minCoeff(), part.rowwise().maxCoeff()});
  }
}

Eigen::Vector2d PlaneCurve::point(double s) const {
  const double x = s * static_cast<double>(size() - 1);
  const Index i = std::clamp(static_cast<Index>(x), 0, size() - 2);
  const double t = x - i;
  return (1.0 - t) * nodes_.col(i) + t * nodes_.col(i + 1);
}

double PlaneCurve::nearest(const Eigen::Vector2d& p) const {
  const auto distance_to = [&](const Block& block) {
    return (block.low - p).cwiseMax(p - block.high).cwiseMax(0.0).squaredNorm();
  };
  const auto block_count = static_cast<Index>(blocks_.size());
  Index start = 0;
  double bound = std::numeric_limits<double>::infinity();
  for (Index b = 0; b < block_count; ++b) {
    const double distance = distance_to(blocks_[b]);
    if (distance < bound) bound = distance, start = b;
  }
  double best = std::numeric_limits<double>::infinity();
  double place = 0.0;
  const auto search = [&](Index b) {
    const Index end = std::min((b + 1) * kBlockSize, size() - 1);
    for (Index i = b * kBlockSize; i < end; ++i) {
      const Eigen::Vector2d segment = nodes_.col(i + 1) - nodes_.col(i);
      const Eigen::Vector2d offset = p - nodes_.col(i);
      const double square = segment.squaredNorm();
      const double t = square > 0.0 ? std::clamp(offset.dot(segment) / square, 0.0, 1.0) : 0.0;
      const double distance = (offset - t * segment).squaredNorm();
      // Ties go to the smaller s, whatever the order of the search.
      if (distance < best || (distance == best && i + t < place)) {
        best = distance;
        place = i + t;
      }
    }
  };
  search(start);
  for (Index b = 0; b < block_count; ++b) {
    if (b != start && distance_to(blocks_[b]) <= best) search(b);
  }
  return std::min(1.0, place / static_cast<double>(size() - 1));
}

PlaneCurve PlaneCurve::starting_at(const Eigen::Vector2d& start) const {
  PlaneCurve moved = *this;
  const Eigen::Vector2d by = start - nodes_.col(0);
  moved.nodes_.colwise() += by;
  for (Block& block : moved.blocks_) {
    block.low += by;
    block.high += by;
  }
  return moved;
}

}  // namespace pliant
