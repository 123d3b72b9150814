#include "pliant/sketch/laid_stroke.h"

#include <algorithm>
#include <utility>

#include "pliant/core/message.h"

namespace pliant {
namespace {

/// Of the shape's size, from the eye: beyond, view coordinates do not tell its points apart.
constexpr double kFarthest = 1e7;

Status check_distance(const Points& view) {
  const double size = (view.rowwise().maxCoeff() - view.rowwise().minCoeff()).norm();
  const double far = view.cwiseAbs().maxCoeff();
  if (far <= kFarthest * size) return {};
  return {ErrorCode::invalid_option,
          message({"camera.eye is ", far, " away from the shape; expected at most 1e7 times its size"})};
}

Result<LaidStroke> laid(const SeenShape& shape, Polyline pixels, std::vector<std::vector<Hit>> hits) {
  const auto met = std::find_if(hits.begin(), hits.end(), [](const std::vector<Hit>& along) { return !along.empty(); });
  const double depth = met != hits.end() ? met->front().depth : shape.view.row(2).mean();
  if (!shape.camera.sees(depth)) {
    return Status(ErrorCode::invalid_option, "camera.eye has the shape behind it; expected the shape in view");
  }
  Polyline nodes(2, pixels.cols());
  for (Index i = 0; i < pixels.cols(); ++i) nodes.col(i) = shape.camera.at_depth(pixels.col(i), depth);
  return LaidStroke{std::move(pixels), std::move(hits), depth, PlaneCurve(std::move(nodes))};
}

}  // namespace

Result<LaidStroke> lay_stroke(const SeenShape& shape, const Polyline& pixels) {
  if (Status status = check_distance(shape.view); !status.ok()) return status;
  return laid(shape, pixels, hits_through(shape.camera, shape.view, shape.triangles, pixels));
}

Result<LaidStroke> reversed(const SeenShape& shape, LaidStroke stroke) {
  std::reverse(stroke.hits.begin(), stroke.hits.end());
  return laid(shape, stroke.pixels.rowwise().reverse(), std::move(stroke.hits));
}

}  // namespace pliant
