#include "pliant/solve/lbfgs.h"

#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

TEST_CASE("L-BFGS with exact line search minimises a quadratic in as many steps as unknowns") {
  constexpr int n = 6;
  test::Random random(4);
  const Eigen::MatrixXd root = random.vector(n * n).reshaped(n, n);
  const Eigen::MatrixXd hessian = root * root.transpose() + 0.5 * Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd minimum = random.vector(n);
  Lbfgs memory(n);
  memory.reset(n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), d(n), g = -hessian * minimum;
  for (int i = 0; i < n; ++i) {
    memory.direction(
        g, [](Eigen::VectorXd&) {}, d);
    const double alpha = -g.dot(d) / d.dot(hessian * d);
    const Eigen::VectorXd step = alpha * d, change = hessian * step;
    x += step;
    g += change;
    memory.remember(step, change);
  }
  CHECK((x - minimum).norm() < 1e-8);
}

TEST_CASE("the first direction is the metric's, and a pair of negative curvature is ignored") {
  Lbfgs memory(3);
  memory.reset(2);
  const Eigen::Vector2d gradient(1.0, -2.0);
  memory.remember(Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0));
  CHECK(memory.empty());
  Eigen::VectorXd d(2);
  memory.direction(
      gradient, [](Eigen::VectorXd& v) { v *= 0.25; }, d);
  CHECK(d == Eigen::VectorXd(Eigen::Vector2d(-0.25, 0.5)));
}
