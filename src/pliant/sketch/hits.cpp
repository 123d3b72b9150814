#include "pliant/sketch/hits.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/sort.h"

namespace pliant {
namespace {

constexpr double kOneDepth = 1e-7;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Shares of the corners (columns) in p, or none where p is outside or the triangle has no area.
bool shares_in(const Eigen::Matrix<double, 2, 3>& corners, const Eigen::Vector2d& p, Eigen::Vector3d& shares) {
  const double area = cross(corners.col(1) - corners.col(0), corners.col(2) - corners.col(0));
  if (area == 0.0) return false;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector2d a = corners.col((c + 1) % 3);
    const Eigen::Vector2d b = corners.col((c + 2) % 3);
    shares[c] = cross(a - p, b - p) / area;
    if (shares[c] < 0.0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::vector<Hit>> hits_through(const Camera& camera, const Points& view, const Triangles& triangles,
                                           const Polyline& pixels) {
  Polyline seen(2, view.cols());
  for (Index p = 0; p < view.cols(); ++p) {
    seen.col(p) = camera.sees(view(2, p)) ? camera.pixel(view.col(p)) : Eigen::Vector2d::Constant(std::nan(""));
  }
  // Along its longer side the stroke is searched by bisection.
  const Eigen::Vector2d extent = pixels.rowwise().maxCoeff() - pixels.rowwise().minCoeff();
  const int axis = extent.y() > extent.x() ? 1 : 0;
  const std::vector<Index> order =
      order_by(static_cast<Index>(pixels.cols()), [&](Index i) { return key_of(pixels(axis, i)); });

  const bool perspective = camera.pixel_size(2.0) != camera.pixel_size(1.0);
  const Eigen::Vector2d low = pixels.rowwise().minCoeff(), high = pixels.rowwise().maxCoeff();
  std::vector<std::vector<Hit>> hits(pixels.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Index a = triangles(0, t), b = triangles(1, t), c = triangles(2, t);
    const auto beside = [&](int k) {
      return std::min({seen(k, a), seen(k, b), seen(k, c)}) > high[k] ||
             std::max({seen(k, a), seen(k, b), seen(k, c)}) < low[k];
    };
    if (beside(0) || beside(1)) continue;
    const double x0 = std::min({seen(axis, a), seen(axis, b), seen(axis, c)});
    const double x1 = std::max({seen(axis, a), seen(axis, b), seen(axis, c)});
    Eigen::Matrix<double, 2, 3> corners;
    corners << seen.col(a), seen.col(b), seen.col(c);
    if (corners.hasNaN()) continue;
    auto place =
        std::lower_bound(order.begin(), order.end(), x0, [&](Index i, double x) { return pixels(axis, i) < x; });
    for (; place != order.end() && pixels(axis, *place) <= x1; ++place) {
      Eigen::Vector3d shares;
      if (!shares_in(corners, pixels.col(*place), shares)) continue;
      const Eigen::Vector3d depths(view(2, a), view(2, b), view(2, c));
      // In perspective the inverse of the depth is linear over the picture.
      const double depth = perspective ? 1.0 / shares.dot(depths.cwiseInverse()) : shares.dot(depths);
      hits[*place].push_back({depth, t});
    }
  }
  for (std::vector<Hit>& along : hits) {
    along = sorted_by(along, [](const Hit& hit) { return key_of(hit.depth); });
    const auto same = [](const Hit& x, const Hit& y) {
      return y.depth - x.depth <= kOneDepth * std::max(std::abs(x.depth), std::abs(y.depth));
    };
    along.erase(std::unique(along.begin(), along.end(), same), along.end());
  }
  return hits;
}

}  // namespace pliant
