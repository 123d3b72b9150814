#include "pliant/deformers/arap/rotations.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/closest_rotation.h"
#include "support/random.h"

using namespace pliant;

namespace {

Rotations fitted(const Rotations& covariances, bool planar = false) {
  Rotations rotations;
  arap::fit_rotations(covariances, planar, rotations);
  return rotations;
}

}  // namespace

TEST_CASE("rotations: the closed form finds what the SVD finds") {
  test::Random random(3);
  Rotations s(9, 401);  // an odd number, for the pairs
  for (auto column : s.colwise()) {
    column = random.vector(9);
    // Flat, nearly linear, tiny and huge neighbourhoods, reflected ones among all of them.
    column.tail<3>() *= std::pow(10.0, -4.0 * (1.0 + random.number()));
    column *= std::pow(10.0, 80.0 * random.number());
  }
  const Rotations r = fitted(s);
  for (Index i = 0; i < s.cols(); ++i) {
    const Eigen::Matrix3d expected = closest_rotation(s.col(i).reshaped(3, 3));
    CHECK((r.col(i).reshaped(3, 3) - expected).norm() < 1e-9);
  }
}

TEST_CASE("rotations: a turned neighbourhood gives the turn, also half a turn and a flat one") {
  for (double angle : {0.0, 1e-9, 1.0, 3.0, std::numbers::pi}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    for (double thickness : {1.0, 0.0}) {
      Rotations s(9, 1);
      s.col(0) = (turn * Eigen::Vector3d(2, 1, thickness).asDiagonal()).reshaped();
      CHECK((fitted(s).col(0).reshaped(3, 3) - turn).norm() < 1e-12);
    }
  }
}

TEST_CASE("rotations: reflected neighbourhoods, whose largest roots are nearly one, have the best rotation") {
  // Where a crumpled cell got another one the energy had no gradient there, and descent stalled.
  test::Random random(11);
  std::vector<Eigen::Vector3d> values;
  for (double second = 0.1; second <= 1.0; second += 0.1) {
    for (double share = 0.0; share < 1.0; share += 0.04) values.emplace_back(1.0, second, -share * second);
  }
  Rotations s(9, static_cast<Index>(values.size()));
  const auto turn = [&] {
    return Eigen::AngleAxisd(random.number(), random.vector(3).normalized()).toRotationMatrix();
  };
  for (Index i = 0; i < s.cols(); ++i) s.col(i) = (turn() * values[i].asDiagonal() * turn()).eval().reshaped();
  const Rotations r = fitted(s);
  for (Index i = 0; i < s.cols(); ++i) {
    CAPTURE(values[i].transpose());
    const Eigen::Matrix3d found = r.col(i).reshaped(3, 3);
    CHECK((found * found.transpose()).isIdentity(1e-9));
    CHECK((found.transpose() * s.col(i).reshaped(3, 3)).trace() == doctest::Approx(values[i].sum()).epsilon(1e-9));
  }
}

TEST_CASE("rotations: nothing to go by gives the identity, a line gives a rotation") {
  Rotations s = Rotations::Zero(9, 2);
  s(0, 1) = 1.0;
  const Rotations r = fitted(s);
  CHECK(r.col(0).reshaped(3, 3) == Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d line = r.col(1).reshaped(3, 3);
  CHECK((line * line.transpose()).isIdentity(1e-12));
  CHECK(line.determinant() == doctest::Approx(1.0));
  CHECK(line(0, 0) == doctest::Approx(1.0));
}

TEST_CASE("rotations: neighbourhoods of a single edge, whose minors are rounding") {
  test::Random random(5);
  Rotations s(9, 2000);
  Points from(3, s.cols()), to(3, s.cols());
  for (Index i = 0; i < s.cols(); ++i) {
    from.col(i) = random.vector(3);
    to.col(i) = random.vector(3);
    s.col(i) = (to.col(i) * from.col(i).transpose()).eval().reshaped();
  }
  const Rotations r = fitted(s);
  for (Index i = 0; i < s.cols(); ++i) {
    const Eigen::Matrix3d turn = r.col(i).reshaped(3, 3);
    CHECK((turn * turn.transpose()).isIdentity(1e-9));
    CHECK(turn.determinant() == doctest::Approx(1.0));
    CHECK((turn * from.col(i).normalized() - to.col(i).normalized()).norm() < 1e-9);
  }
}

TEST_CASE("rotations: planar ones turn about z only, mirrored neighbourhoods included") {
  Rotations s(9, 2);
  s.col(0) = (Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(3, 1, 0).asDiagonal()).reshaped();
  s.col(1) = Eigen::Matrix3d(Eigen::Vector3d(2, -1, 0).asDiagonal()).reshaped();
  const Rotations r = fitted(s, true);
  CHECK((r.col(0).reshaped(3, 3) - Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix()).norm() < 1e-14);
  CHECK(r.col(1).reshaped(3, 3) == Eigen::Matrix3d::Identity());
}
