#include "pliant/geometry/loose_parts.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/core/disjoint_sets.h"
#include "pliant/core/sort.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/point_grid.h"

namespace pliant {
namespace {

/// Largest share of the shape's diagonal, and of the points of its largest part.
constexpr double kLargest = 0.3;
constexpr std::size_t kFewer = 5;
/// Points of a part whose nearest neighbours it lies beside.
constexpr std::size_t kFeelers = 48;
constexpr int kRings = 2;

/// Points that triangles join, part by part.
std::vector<std::vector<Index>> joined_parts(const Shape& shape) {
  DisjointSets sets(static_cast<Index>(shape.points().cols()));
  for (Index t = 0; t < shape.triangles().cols(); ++t) {
    for (int corner = 1; corner < 3; ++corner) sets.join(shape.triangles()(0, t), shape.triangles()(corner, t));
  }
  const auto [count, of] = sets.numbered();
  std::vector<std::vector<Index>> parts(count);
  for (Index point = 0; point < static_cast<Index>(of.size()); ++point) parts[of[point]].push_back(point);
  return parts;
}

double diagonal_of(const Points& points, const std::vector<Index>& some) {
  Eigen::AlignedBox3d box;
  for (const Index point : some) box.extend(points.col(point));
  return box.diagonal().norm();
}

/// Of each of some places the nearest point that may be chosen; there is one.
std::vector<Index> nearest(const Shape& shape, const std::vector<bool>& may, std::vector<Index> places) {
  const Points& points = shape.points();
  std::vector<Index> found;
  for (double reach = shape.diagonal() / 32.0; !places.empty(); reach *= 4.0) {
    const PointGrid grid(points, reach);
    std::erase_if(places, [&](Index place) {
      Index best = -1;
      double least = std::numeric_limits<double>::infinity();
      grid.for_each_near(points.col(place), [&](Index point, double squared) {
        if (may[point] && (squared < least || (squared == least && point < best))) {
          best = point;
          least = squared;
        }
      });
      if (best >= 0) found.push_back(best);
      return best >= 0;
    });
  }
  return found;
}

/// Some points and those a few edges away, ascending.
std::vector<Index> widened(const Shape& shape, const Incidence& around, std::vector<Index> points) {
  std::vector<bool> reached(around.rows(), false);
  for (const Index point : points) reached[point] = true;
  for (int ring = 0; ring < kRings; ++ring) {
    const std::size_t inner = points.size();
    for (std::size_t i = 0; i < inner; ++i) {
      for (const Index t : around.row(points[i])) {
        for (const Index corner : shape.triangles().col(t)) {
          if (!reached[corner]) points.push_back(corner);
          reached[corner] = true;
        }
      }
    }
  }
  points.clear();
  for (Index point = 0; point < around.rows(); ++point) {
    if (reached[point]) points.push_back(point);
  }
  return points;
}

std::vector<Index> beside(const Shape& shape, const Incidence& around, const std::vector<bool>& large,
                          const std::vector<Index>& part) {
  std::vector<Index> feelers;
  const std::size_t stride = (part.size() + kFeelers - 1) / kFeelers;
  for (std::size_t i = 0; i < part.size(); i += stride) feelers.push_back(part[i]);
  return widened(shape, around, nearest(shape, large, std::move(feelers)));
}

}  // namespace

std::vector<LoosePart> loose_parts(const Shape& shape) {
  const Index count = static_cast<Index>(shape.points().cols());
  if (shape.dimension() == 2 || shape.triangles().size() < count || shape.report().components == 1) return {};
  std::vector<std::vector<Index>> parts = joined_parts(shape);
  std::size_t most = 0;
  for (const auto& part : parts) most = std::max(most, part.size());
  std::erase_if(parts, [&](const std::vector<Index>& part) {
    return part.size() * kFewer >= most || diagonal_of(shape.points(), part) >= kLargest * shape.diagonal();
  });
  if (parts.size() > kMostLooseParts) return {};

  std::vector<bool> large(count, true);
  for (const auto& part : parts) {
    for (const Index point : part) large[point] = false;
  }
  const Incidence around = triangles_of_points(shape.triangles(), count);
  std::vector<LoosePart> loose;
  const auto fewer = [&](Index part) { return key_of(0, static_cast<Index>(most - parts[part].size())); };
  for (const Index part : order_by(static_cast<Index>(parts.size()), fewer)) {
    std::vector<Index> anchors = beside(shape, around, large, parts[part]);
    loose.push_back({std::move(parts[part]), std::move(anchors)});
  }
  return loose;
}

}  // namespace pliant
