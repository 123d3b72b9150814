#include "pliant/sketch/stroke.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "pliant/core/message.h"

namespace pliant {
namespace {

constexpr double kReach = 8.0;         // pixels to each side that the average takes in
constexpr double kReachShare = 0.125;  // of a short stroke's length
constexpr double kMaxPixel = 1e6;
constexpr Index kMaxSamples = 8000;

/// The value at `center` of the parabola fitted to the samples from `first` to `last`, near ones
/// counting more.
Eigen::Vector2d smoothed_sample(const Polyline& line, Index first, Index last, Index center, double half_width) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (Index i = first; i <= last; ++i) {
    const double x = (i - center) / half_width;
    const double weight = 1.0 - x * x;
    const Eigen::Vector3d basis(1.0, x, x * x);
    normal += weight * basis * basis.transpose();
    right += weight * basis * (line.col(i) - line.col(center)).transpose();
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  return line.col(center) + (inverse.row(0) * right).transpose();
}

Polyline averaged(const Polyline& line, double spacing) {
  const Index n = static_cast<Index>(line.cols());
  const double length = spacing * (n - 1);
  const Index k = std::max<Index>(2, static_cast<Index>(std::lround(std::min(kReach, kReachShare * length) / spacing)));
  Polyline result(2, n);
  for (Index i = 0; i < n; ++i) {
    result.col(i) = smoothed_sample(line, std::max<Index>(0, i - k), std::min(n - 1, i + k), i, k + 1.0);
  }
  return result;
}

}  // namespace

Status check_stroke(const Stroke& stroke, const char* argument) {
  if (stroke.cols() < 2) {
    return {ErrorCode::invalid_option, message({argument, " has ", stroke.cols(), " samples; expected at least 2"})};
  }
  for (Index i = 0; i < stroke.cols(); ++i) {
    // Written so that NaN fails too.
    if (!(stroke.col(i).cwiseAbs().maxCoeff() <= kMaxPixel) || stroke.col(i).hasNaN()) {
      return {ErrorCode::invalid_option,
              message({argument, "[", i, "] is not a pixel; expected two numbers up to 1e6"})};
    }
  }
  const double extent = (stroke.rowwise().maxCoeff() - stroke.rowwise().minCoeff()).eval().norm();
  if (extent < kMinStrokeSegment) {
    return {ErrorCode::invalid_option,
            message({argument, " spans ", extent, " pixels; expected at least ", kMinStrokeSegment})};
  }
  return {};
}

Index nodes_for(const Stroke& stroke) {
  const double segments = length_of(stroke) / kMinStrokeSegment;
  return static_cast<Index>(
      std::clamp(segments + 1.0, static_cast<double>(kMinStrokeNodes), static_cast<double>(kMaxStrokeNodes)));
}

Stroke filtered(const Stroke& stroke, Index nodes) {
  const double length = length_of(stroke);
  // About one sample a pixel, so that the average weighs the stroke, not the pen's speed.
  const Index samples =
      static_cast<Index>(std::clamp(std::ceil(length), 4.0 * nodes, static_cast<double>(kMaxSamples)));
  const double spacing = length / (samples - 1);
  return resampled(averaged(sampled(stroke, samples), spacing), nodes);
}

Stroke without_start(const Stroke& stroke, double fraction) {
  if (fraction == 0.0) return stroke;
  const double place = fraction * static_cast<double>(stroke.cols() - 1);
  const Index first = static_cast<Index>(place);
  Stroke rest = stroke.rightCols(stroke.cols() - first);
  rest.col(0) += (place - first) * (rest.col(1) - rest.col(0));
  return resampled(rest, static_cast<Index>(stroke.cols()));
}

Stroke from_held_end(const Stroke& drawn, bool held_at_end) {
  return held_at_end ? Stroke(drawn.rowwise().reverse()) : drawn;
}

}  // namespace pliant
