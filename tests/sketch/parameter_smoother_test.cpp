#include "pliant/sketch/parameter_smoother.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "pliant/geometry/adjacency.h"
#include "pliant/sketch/stroke.h"
#include "pliant/sketch/tether.h"
#include "support/random.h"
#include "support/shapes.h"

namespace pliant {
namespace {

TEST_CASE("the smoothed parameters minimise eq. 9") {
  const test::Mesh mesh = test::potato(2);
  const auto shape = test::shape_of(mesh);
  const Index n = static_cast<Index>(shape->points().cols()), free = n - 20;
  const EdgeTable edges = unique_edges(shape->triangles(), n);
  std::vector<Index> points(n);
  std::iota(points.begin(), points.end(), 0);
  test::Random random(3);
  const Eigen::VectorXd raw = random.vector(free), pinned = random.vector(20);

  // E = sum_i sum_j w (u_i - u_j)^2 + w_c (u_i - raw_i)^2: both ends of an edge count it.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(free, free);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(free), sums = Eigen::VectorXd::Zero(n);
  for (const auto& [a, b] : edges.ends) {
    const double w = 1.0 / (shape->points().col(a) - shape->points().col(b)).norm();
    sums[a] += w;
    sums[b] += w;
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      if (i >= free) continue;
      matrix(i, i) += 2.0 * w;
      if (j < free) {
        matrix(i, j) -= 2.0 * w;
      } else {
        right[i] += 2.0 * w * pinned[j - free];
      }
    }
  }
  for (Index i = 0; i < free; ++i) {
    matrix(i, i) += sums[i] / 10.0;
    right[i] += sums[i] / 10.0 * raw[i];
  }
  const Eigen::VectorXd exact = matrix.partialPivLu().solve(right);

  ParameterSmoother smoother(shape->points(), points, free, edges.ends);
  std::vector<double> u(free, 0.0);
  const int passes = smoother.solve({raw.data(), static_cast<std::size_t>(free)}, {pinned.data(), 20}, u);
  CHECK(passes < 40);
  for (Index i = 0; i < free; ++i) CHECK(std::abs(u[i] - exact[i]) < 1e-6);
}

TEST_CASE("constants stay, and a solved guess takes no pass") {
  const auto shape = test::shape_of(test::plane_grid(20, 20));
  const EdgeTable edges = unique_edges(shape->triangles(), 400);
  std::vector<Index> points(400);
  std::iota(points.begin(), points.end(), 0);
  ParameterSmoother smoother(shape->points(), points, 380, edges.ends);
  const std::vector<double> raw(380, 0.7), pinned(20, 0.7);
  std::vector<double> u(380, 0.0);
  CHECK(smoother.solve(raw, pinned, u) > 0);
  for (const double x : u) CHECK(x == doctest::Approx(0.7).epsilon(1e-6));
  u = raw;
  CHECK(smoother.solve(raw, pinned, u) == 0);
}

TEST_CASE("a tether bounds what differs near a pin and leaves the rest") {
  // A chain of unit steps, pinned at its end to 0.
  const Index n = 12;
  Points line = Points::Zero(3, n);
  std::vector<std::array<Index, 2>> edges;
  std::vector<Index> ids(n);
  std::iota(ids.begin(), ids.end(), 0);
  for (Index i = 0; i < n; ++i) line(0, i) = i;
  for (Index i = 0; i + 1 < n; ++i) edges.push_back({i, i + 1});
  const std::vector<double> pinned{0.0};
  std::vector<double> values(n - 1, 0.55);
  tether(line, ids, edges, pinned, 0.1, 0.05, values);
  for (Index i = 0; i < n - 1; ++i) {
    CHECK(values[i] == doctest::Approx(std::min(0.55, 0.1 + 0.05 * (n - 1 - i))));
  }
  const std::vector<double> once = values;
  tether(line, ids, edges, pinned, 0.1, 0.05, values);
  CHECK(values == once);
}

TEST_CASE("the filter keeps straight and round strokes and takes noise") {
  Stroke line(2, 50), round(2, 300), noisy(2, 300);
  test::Random random(4);
  for (Index i = 0; i < 50; ++i) line.col(i) << 3.0 * i, 100.0 + 4.0 * i;
  for (Index i = 0; i < 300; ++i) {
    const double a = 3.0 * i / 299;
    round.col(i) << 150 * std::cos(a), 150 * std::sin(a);
    noisy.col(i) = round.col(i) + 1.5 * Eigen::Vector2d(random.number(), random.number());
  }
  const Stroke kept = filtered(line, 61);
  for (Index i = 0; i < 61; ++i) {
    CHECK((kept.col(i) - Eigen::Vector2d(147.0 * i / 60, 100.0 + 196.0 * i / 60)).norm() < 1e-6);
  }
  const auto worst = [](const Stroke& stroke) { return (stroke.colwise().norm().array() - 150.0).abs().maxCoeff(); };
  CHECK(nodes_for(round) == 90);  // almost 450 pixels in segments of at least 5
  CHECK(worst(filtered(round, 91)) < 0.02);
  CHECK(worst(filtered(noisy, 91)) < 0.7 * worst(noisy));
  CHECK(length_of(filtered(round, 91)) == doctest::Approx(450.0).epsilon(0.001));
  // A part of the way is dropped evenly.
  CHECK(length_of(without_start(kept, 0.2)) == doctest::Approx(0.8 * length_of(kept)));
}

}  // namespace
}  // namespace pliant
