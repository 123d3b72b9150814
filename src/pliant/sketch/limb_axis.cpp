#include "pliant/sketch/limb_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "pliant/core/disjoint_sets.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/edge_distance.h"
#include "pliant/sketch/laid_stroke.h"

namespace pliant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLevels = 256;
constexpr int kSections = 12;
constexpr double kLeastTriangles = 12.0;  // before a level counts
constexpr double kSlender = 5.0;          // length^2 / area: pi where a limb is as long as thick, 2 pi on a ball
constexpr double kRise = 2.0;             // of that measure, where the body begins

/// What lies within a distance of a place.
struct Level {
  double length = 0.0;  ///< of the line at that distance
  double area = 0.0;
  double triangles = 0.0;
};

class LimbFinder {
 public:
  LimbFinder(const Triangles& triangles, Points view)
      : triangles_(triangles),
        view_(std::move(view)),
        around_(triangles_of_points(triangles, static_cast<Index>(view_.cols()))) {}

  /// Places in view coordinates along the middle of the limb around a place on a triangle, from its
  /// root on; none: no limb.
  Points axis(Index triangle, const Eigen::Vector3d& place) {
    distance_.assign(view_.cols(), kInfinity);
    for (const Index p : triangles_.col(triangle)) distance_[p] = (view_.col(p) - place).norm();
    spread_distances(view_, triangles_, around_, kInfinity, distance_);
    const double root = find_root();
    if (!(root > 0.0)) return Points(3, 0);
    // Along the limb: from the points at its root on.
    std::vector<double> from_root = distances_from_root(root);
    double last = 0.0;
    for (const Index p : triangles_.col(triangle)) last = std::max(last, from_root[p]);
    if (!(last > 0.0 && last < kInfinity)) return Points(3, 0);
    return middles(from_root, last);
  }

 private:
  double level_step() const {
    double farthest = 0.0;
    for (const double d : distance_) farthest = d < kInfinity ? std::max(farthest, d) : farthest;
    return farthest / kLevels;
  }

  std::vector<Level> levels(double step) const {
    std::vector<Level> levels(kLevels + 1);
    for (const auto& corners : triangles_.colwise()) {
      Index c[3] = {corners[0], corners[1], corners[2]};  // by distance
      for (const int k : {0, 1, 0}) {
        if (distance_[c[k]] > distance_[c[k + 1]]) std::swap(c[k], c[k + 1]);
      }
      const double d0 = distance_[c[0]], d1 = distance_[c[1]], d2 = distance_[c[2]];
      if (d2 == kInfinity) continue;
      const Eigen::Vector3d a = view_.col(c[0]), b = view_.col(c[1]), e = view_.col(c[2]);
      Level& whole = levels[std::min(kLevels, static_cast<int>(std::ceil((d0 + d1 + d2) / (3.0 * step))))];
      whole.area += 0.5 * (b - a).cross(e - a).norm();
      whole.triangles += 1.0;
      for (int k = static_cast<int>(std::ceil(d0 / step)); k <= kLevels && k * step < d2; ++k) {
        const double d = k * step;
        const Eigen::Vector3d far = a + (d - d0) / (d2 - d0) * (e - a);
        const bool low = d < d1;
        const double t = low ? (d - d0) / (d1 - d0) : (d - d1) / (d2 - d1);
        levels[k].length += (far - (low ? a : b) - t * (low ? Eigen::Vector3d(b - a) : Eigen::Vector3d(e - b))).norm();
      }
    }
    for (int k = 1; k <= kLevels; ++k) {
      levels[k].area += levels[k - 1].area;
      levels[k].triangles += levels[k - 1].triangles;
    }
    return levels;
  }

  /// The distance at which the limb ends, or 0.
  double find_root() const {
    const double step = level_step();
    if (!(step > 0.0)) return 0.0;
    const std::vector<Level> all = levels(step);
    double least = kSlender;
    int best = 0;
    for (int k = 1; k <= kLevels && all[k].area < 0.5 * all.back().area; ++k) {
      if (all[k].triangles < kLeastTriangles) continue;
      const double measure = all[k].length * all[k].length / all[k].area;
      if (measure < least) {
        least = measure;
        best = k;
      } else if (best > 0 && measure > kRise * least) {
        break;
      }
    }
    return best * step;
  }

  /// The body is the largest part beyond the root; all else, also a tip farther away than the root,
  /// is the limb. Distances inside it, infinite in the body.
  std::vector<double> distances_from_root(double root) const {
    const auto points = static_cast<Index>(view_.cols());
    DisjointSets sets(points);
    const auto beyond = [&](Index p) { return distance_[p] >= root && distance_[p] < kInfinity; };
    for (const auto& corners : triangles_.colwise()) {
      for (int c = 0; c < 3; ++c) {
        if (beyond(corners[c]) && beyond(corners[(c + 1) % 3])) sets.join(corners[c], corners[(c + 1) % 3]);
      }
    }
    const std::vector<Index> set = sets.roots();
    std::vector<Index> size(points, 0);
    for (Index p = 0; p < points; ++p) size[set[p]] += beyond(p);
    const auto body = static_cast<Index>(std::max_element(size.begin(), size.end()) - size.begin());
    std::vector<double> from_root(points, kInfinity);
    for (const auto& corners : triangles_.colwise()) {
      const auto in_body = [&](Index p) { return beyond(p) && set[p] == body; };
      if (!in_body(corners[0]) && !in_body(corners[1]) && !in_body(corners[2])) continue;
      for (const Index p : corners) {
        if (!in_body(p)) from_root[p] = 0.0;
      }
    }
    const auto neighbours = [&](Index i, const auto& visit) {
      for (const Index t : around_.row(i)) {
        for (const Index j : triangles_.col(t)) {
          if (j != i && !(beyond(j) && set[j] == body)) visit(j, (view_.col(j) - view_.col(i)).norm());
        }
      }
    };
    spread_distances(neighbours, kInfinity, from_root);
    return from_root;
  }

  /// Centres of the surface between equal distances from the root, as far as `last`.
  Points middles(const std::vector<double>& from_root, double last) const {
    Points sums = Points::Zero(3, kSections);
    std::vector<double> weights(kSections, 0.0);
    for (const auto& corners : triangles_.colwise()) {
      const double d = (from_root[corners[0]] + from_root[corners[1]] + from_root[corners[2]]) / 3.0;
      const auto section = d < last ? static_cast<Index>(kSections * d / last) : kSections;
      if (section >= kSections) continue;
      const Eigen::Vector3d a = view_.col(corners[0]), b = view_.col(corners[1]), c = view_.col(corners[2]);
      const double area = 0.5 * (b - a).cross(c - a).norm();
      sums.col(section) += area * (a + b + c) / 3.0;
      weights[section] += area;
    }
    Points result(3, kSections);
    Index count = 0;
    for (Index k = 0; k < kSections; ++k) {
      if (weights[k] > 0.0) result.col(count++) = sums.col(k) / weights[k];
    }
    return result.leftCols(count);
  }

  const Triangles& triangles_;
  Points view_;
  Incidence around_;
  std::vector<double> distance_;  ///< along edges, from the place
};

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

}  // namespace

Result<Stroke> stroke_along_limb(const Shape& shape, const Camera& camera, const Eigen::Vector2d& pixel) {
  if (!pixel.allFinite()) return invalid("pixel is not finite; expected two numbers");
  Points view(3, shape.points().cols());
  for (Index p = 0; p < view.cols(); ++p) view.col(p) = camera.to_view(shape.points().col(p));
  const auto hits = hits_through(camera, view, shape.triangles(), pixel);
  if (hits.front().empty()) return invalid("pixel lies beside the shape; expected one on a limb");
  const Hit hit = hits.front().front();
  Eigen::Vector3d place;
  place << camera.at_depth(pixel, hit.depth), hit.depth;
  const Points axis = LimbFinder(shape.triangles(), std::move(view)).axis(hit.triangle, place);
  if (axis.cols() < 2) return invalid("pixel does not lie on a limb; expected a part longer than thick");
  Stroke stroke(2, axis.cols());
  for (Index i = 0; i < axis.cols(); ++i) {
    if (!camera.sees(axis(2, i)))
      return invalid("pixel lies on a limb that reaches behind the eye; expected it in view");
    stroke.col(i) = camera.pixel(axis.col(i));
  }
  if (!check_stroke(stroke, "pixel").ok())
    return invalid("pixel lies on a limb seen from its end; expected it from the side");
  return stroke;
}

}  // namespace pliant
