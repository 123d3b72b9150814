#include "pliant/solve/approach.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace pliant;

TEST_CASE("way left: steps that shrink by a factor add up to a geometric series") {
  for (double ratio : {0.3, 0.9, 0.99}) {
    Approach approach;
    double step = 1.0;
    for (int i = 0; i < 100; ++i) approach.add(step *= ratio);
    // Sums of windows shrink faster than steps, which is counted: never less than what is left.
    const double left = step * ratio / (1.0 - ratio);
    CHECK(approach.left() >= left * (1.0 - 1e-9));
    CHECK(approach.left() == doctest::Approx(left).epsilon(1e-9));
  }
}

TEST_CASE("way left: steps that do not shrink lead anywhere, those of no length nowhere") {
  Approach approach;
  CHECK(std::isinf(approach.left()));
  approach.add(1.0);
  CHECK(approach.left() > 1.0);
  for (int i = 0; i < 40; ++i) approach.add(1.0);
  CHECK(std::isinf(approach.left()));
  for (int i = 0; i < 40; ++i) approach.add(0.0);
  CHECK(approach.left() == 0.0);
  approach.restart();
  CHECK(std::isinf(approach.left()));
}

TEST_CASE("way left: one short step among long ones is no end") {
  Approach approach;
  for (int i = 0; i < 40; ++i) approach.add(i == 39 ? 1e-9 : std::pow(0.98, i));
  CHECK(approach.left() > 0.1);
}
