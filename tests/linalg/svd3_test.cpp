#include "pliant/linalg/svd3.h"

#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

TEST_CASE("the decomposition multiplies back and its factors are orthogonal, whatever the rank") {
  test::Random random(11);
  for (int i = 0; i < 60; ++i) {
    Eigen::Matrix3d m = random.vector(9).reshaped(3, 3);
    if (i % 3 == 1) m.col(2) = m.col(0) - m.col(1);
    if (i % 3 == 2) m = m.col(0) * m.row(1);
    const Svd3 svd = svd3(m);
    CHECK((svd.u * svd.values.asDiagonal() * svd.v.transpose() - m).norm() < 1e-14 * (1.0 + m.norm()));
    CHECK((svd.u.transpose() * svd.u - Eigen::Matrix3d::Identity()).norm() < 1e-13);
    CHECK((svd.v.transpose() * svd.v - Eigen::Matrix3d::Identity()).norm() < 1e-13);
    CHECK(svd.values[0] >= svd.values[1]);
    CHECK(svd.values[1] >= svd.values[2]);
    CHECK(svd.values[2] >= 0.0);
  }
}
