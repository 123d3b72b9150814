#include "pliant/curves/plane_curve.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "support/random.h"

namespace pliant {
namespace {

constexpr double pi = std::numbers::pi;

Polyline arc(double radius, double angle, Index nodes) {
  Polyline line(2, nodes);
  for (Index i = 0; i < nodes; ++i) {
    const double a = angle * i / (nodes - 1);
    line.col(i) << radius * std::sin(a), radius * (1.0 - std::cos(a));
  }
  return line;
}

Polyline wandering(Index nodes, std::uint32_t seed) {
  test::Random random(seed);
  Polyline line = Polyline::Zero(2, nodes);
  double heading = 0.0;
  for (Index i = 1; i < nodes; ++i) {
    heading += 0.4 * random.number();
    const double step = 1.5 + random.number();
    line.col(i) = line.col(i - 1) + step * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  }
  return line;
}

TEST_CASE("a resampled line has equal steps and keeps both ends") {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const Polyline line = wandering(40, seed);
    const Polyline even = resampled(line, 77);
    CHECK((even.col(0) - line.col(0)).norm() == 0.0);
    CHECK((even.col(76) - line.col(39)).norm() < 1e-12);
    const double step = length_of(even) / 76;
    for (Index i = 0; i + 1 < 77; ++i) {
      CHECK((even.col(i + 1) - even.col(i)).norm() == doctest::Approx(step).epsilon(1e-5));
    }
  }
}

TEST_CASE("start, heading, turns and step say all of a curve") {
  const PlaneCurve curve(resampled(wandering(50, 3), 61));
  const PlaneCurve again(curve.nodes().col(0), curve.heading(), curve.turns(), curve.step());
  CHECK((again.nodes() - curve.nodes()).cwiseAbs().maxCoeff() < 1e-4 * curve.length());
}

TEST_CASE("a circle turns evenly up to its ends") {
  for (const double angle : {pi / 2, pi, 2 * pi}) {
    const PlaneCurve curve(arc(3.0, angle, 61));
    CHECK(curve.turning(1.0) - curve.turning(0.0) == doctest::Approx(angle).epsilon(1e-9));
    for (double s = 0.0; s <= 1.0; s += 0.0317) {
      CHECK(curve.heading() + curve.turning(s) == doctest::Approx(angle * s).epsilon(1e-9));
    }
    // Eq. 4: in the middle of a segment the tangent is along it.
    CHECK(curve.turning(0.5 / 60) == doctest::Approx(0.0));
  }
}

TEST_CASE("the nearest point is that of a search over all segments") {
  const PlaneCurve curve(resampled(wandering(60, 9), 121));
  test::Random random(5);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Vector2d p = 40.0 * Eigen::Vector2d(random.number() + 1.0, random.number());
    double best = 1e300;
    for (int k = 0; k <= 120 * 50; ++k) {
      best = std::min(best, (curve.point(k / (120.0 * 50)) - p).norm());
    }
    CHECK((curve.point(curve.nearest(p)) - p).norm() <= best + 1e-12);
  }
}

}  // namespace
}  // namespace pliant
