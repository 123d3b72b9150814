#include "pliant/curves/profile.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace pliant {
namespace {

Status bad_point(const char* argument, std::size_t i, const Profile::Point& point, const char* expected) {
  char text[160];
  std::snprintf(text, sizeof text, "%s[%zu] is [%.6g, %.6g]; expected %s", argument, i, point.first, point.second,
                expected);
  return {ErrorCode::invalid_option, text};
}

}  // namespace

Result<Profile> Profile::create(std::span<const Point> points, const char* argument) {
  if (points.empty()) {
    return Status(ErrorCode::invalid_option, std::string(argument) + " is empty; expected at least one point [s, f]");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [s, f] = points[i];
    if (!std::isfinite(f)) return bad_point(argument, i, points[i], "finite numbers");
    if (!(s >= 0.0 && s <= 1.0)) return bad_point(argument, i, points[i], "s from 0 to 1");
    if (i > 0 && s < points[i - 1].first) {
      return bad_point(argument, i, points[i], "s not below that of the point before");
    }
  }
  return Profile({points.begin(), points.end()});
}

double Profile::operator()(double s) const {
  const auto above =
      std::upper_bound(points_.begin(), points_.end(), s, [](double x, const Point& p) { return x < p.first; });
  if (above == points_.begin()) return points_.front().second;
  const auto [s0, f0] = *(above - 1);
  if (above == points_.end()) return f0;
  const auto [s1, f1] = *above;
  return f0 + (f1 - f0) * (s - s0) / (s1 - s0);
}

/// The limit from the left.
double Profile::before(double s) const {
  const auto at =
      std::lower_bound(points_.begin(), points_.end(), s, [](const Point& p, double x) { return p.first < x; });
  if (at == points_.begin()) return points_.front().second;
  if (at == points_.end()) return points_.back().second;
  const auto [s0, f0] = *(at - 1);
  const auto [s1, f1] = *at;
  return f0 + (f1 - f0) * (s - s0) / (s1 - s0);
}

Profile Profile::times(double k) const {
  std::vector<Point> points = points_;
  for (Point& point : points) point.second *= k;
  return Profile(std::move(points));
}

Profile Profile::blend(const Profile& a, const Profile& b, double t) {
  std::vector<double> places;
  for (const Profile* profile : {&a, &b}) {
    for (const Point& point : profile->points_) places.push_back(point.first);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<Point> points;
  for (const double s : places) {
    const double left = (1.0 - t) * a.before(s) + t * b.before(s);
    const double right = (1.0 - t) * a(s) + t * b(s);
    if (left != right) points.emplace_back(s, left);
    points.emplace_back(s, right);
  }
  return Profile(std::move(points));
}

}  // namespace pliant
