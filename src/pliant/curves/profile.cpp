#include "pliant/curves/profile.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/message.h"

namespace pliant {
namespace {

Status bad_point(const char* argument, std::size_t i, const Profile::Point& point, const char* expected) {
  return {ErrorCode::invalid_option,
          message({argument, "[", i, "] is [", point.first, ", ", point.second, "]; expected ", expected})};
}

}  // namespace

Result<Profile> Profile::create(std::span<const Point> points, const char* argument) {
  if (points.empty()) {
    return Status(ErrorCode::invalid_option, message({argument, " is empty; expected at least one point [s, f]"}));
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
  std::vector<Point> both(a.points_.size() + b.points_.size());
  const auto lower = [](const Point& x, const Point& y) { return x.first < y.first; };
  std::merge(a.points_.begin(), a.points_.end(), b.points_.begin(), b.points_.end(), both.begin(), lower);
  std::vector<Point> points;
  for (std::size_t i = 0; i < both.size(); ++i) {
    const double s = both[i].first;
    if (i > 0 && s == both[i - 1].first) continue;
    const double left = (1.0 - t) * a.before(s) + t * b.before(s);
    const double right = (1.0 - t) * a(s) + t * b(s);
    if (left != right) points.emplace_back(s, left);
    points.emplace_back(s, right);
  }
  return Profile(std::move(points));
}

}  // namespace pliant
