#include "pliant/deformers/embedded_graph/barrier.h"

#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

using namespace pliant::embedded;

TEST_CASE("the barrier is zero where determinants are safe, smooth there, and infinite at a reflection") {
  CHECK(barrier::value(1.0) == 0.0);
  CHECK(barrier::value(barrier::kSafeDeterminant) == 0.0);
  CHECK(barrier::slope(barrier::kSafeDeterminant * (1 - 1e-6)) == doctest::Approx(0.0).epsilon(1e-4));
  CHECK(std::isinf(barrier::value(0.0)));
  CHECK(std::isinf(barrier::value(-0.3)));
}

TEST_CASE("derivatives of the barrier agree with central differences") {
  for (double d : {0.002, 0.02, 0.05, 0.09}) {
    const double h = 1e-7;
    CHECK(barrier::slope(d) ==
          doctest::Approx((barrier::value(d + h) - barrier::value(d - h)) / (2 * h)).epsilon(1e-6));
    CHECK(barrier::curvature(d) ==
          doctest::Approx((barrier::slope(d + h) - barrier::slope(d - h)) / (2 * h)).epsilon(1e-6));
    CHECK(barrier::curvature(d) > 0.0);
  }
}
