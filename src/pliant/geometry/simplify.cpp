#include "pliant/geometry/simplify.h"

#include <cmath>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/geometry/canonical_order.h"
#include "pliant/geometry/collapser.h"

namespace pliant {
namespace {

Status check(const Shape& shape, const SimplifyOptions& options) {
  const auto points = shape.points().cols();
  if (shape.triangles().cols() == 0) {
    return {ErrorCode::invalid_option, "shape has no triangles; expected a mesh to simplify"};
  }
  if (options.target_points < 1 || options.target_points > points) {
    return {ErrorCode::invalid_option, message({"target_points is ", options.target_points, "; expected 1 to ", points,
                                                ", the points of the shape"})};
  }
  // An equilateral triangle has 1.15.
  if (!(options.max_aspect_ratio >= 2.0)) {
    return {ErrorCode::invalid_option,
            message({"max_aspect_ratio is ", options.max_aspect_ratio, "; expected at least 2"})};
  }
  return {};
}

}  // namespace

Result<std::vector<Index>> simplify(const Shape& shape, const SimplifyOptions& options) {
  if (Status status = check(shape, options); !status.ok()) {
    return status;
  }
  const std::vector<Index> order = canonical_order(shape);
  // In units of the shape's spread, so that costs round alike at every scale.
  Points points = shape.points()(Eigen::all, order);
  const Eigen::Vector3d center = points.rowwise().mean();
  points.colwise() -= center;
  points /= std::sqrt(points.colwise().squaredNorm().mean());
  Collapser collapser(std::move(points), canonical_triangles(shape, order), options.max_aspect_ratio);
  collapser.run(options.target_points);

  std::vector<Index> survivors;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    if (collapser.is_left(static_cast<Index>(rank))) {
      survivors.push_back(order[rank]);
    }
  }
  return survivors;
}

}  // namespace pliant
