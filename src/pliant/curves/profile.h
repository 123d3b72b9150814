// A function of the normalised arc length, as a user draws it in a spline box: linear between
// points.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "pliant/core/status.h"

namespace pliant {

/// F(s) on [0, 1]: linear between its points, constant beyond the first and the last.
class Profile {
 public:
  /// A point (s, F(s)).
  using Point = std::pair<double, double>;

  /// F(s) = value everywhere.
  static Profile constant(double value) { return Profile({{0.0, value}}); }
  /// F(s) = s.
  static Profile identity() { return Profile({{0.0, 0.0}, {1.0, 1.0}}); }

  /// At least one point, s in [0, 1] ascending (two points at one s make a jump).
  /// Errors: invalid_option, naming `argument` ("scale.profile").
  static Result<Profile> create(std::span<const Point> points, const char* argument);

  double operator()(double s) const;

  /// (1 - t) a + t b, exactly: it bends where either does.
  static Profile blend(const Profile& a, const Profile& b, double t);

  /// k F(s).
  Profile times(double k) const;

  const std::vector<Point>& points() const { return points_; }
  friend bool operator==(const Profile&, const Profile&) = default;

 private:
  explicit Profile(std::vector<Point> points) : points_(std::move(points)) {}
  double before(double s) const;

  std::vector<Point> points_;
};

}  // namespace pliant
