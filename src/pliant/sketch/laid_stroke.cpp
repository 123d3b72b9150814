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

}  // namespace

Result<LaidStroke> lay_stroke(const SeenShape& shape, const Polyline& pixels) {
  if (Status status = check_distance(shape.view); !status.ok()) return status;
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

}  // namespace pliant
