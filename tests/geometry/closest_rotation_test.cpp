#include "pliant/geometry/closest_rotation.h"

#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

namespace {

RigidMotion fit(const Points& from, const Points& to) {
  RigidFit fit;
  for (Index i = 0; i < from.cols(); ++i) fit.add(from.col(i), to.col(i));
  return fit.motion();
}

}  // namespace

TEST_CASE("a rigid motion is found again, also of a small shape far from the origin") {
  test::Random random(3);
  for (double distance : {0.0, 1e6}) {
    const Points from = random.vector(3 * 50).reshaped(3, 50).array() + distance;
    const Eigen::Matrix3d rotation = rotation_of({0.3, -2.0, 1.1});
    const Points to = (rotation * from).colwise() + Eigen::Vector3d(4, -5, 6);
    const RigidMotion motion = fit(from, to);
    CHECK((motion.rotation - rotation).norm() < 1e-9);
    const Points fitted = (motion.rotation * from).colwise() + motion.translation;
    CHECK((fitted - to).norm() < 1e-15 * (1.0 + distance) * 50 * 50);
  }
}

TEST_CASE("where the points leave the turn open it is the smallest one") {
  Points from(3, 1), to(3, 1);
  from << 1, 2, 3;
  to << 4, 4, 4;
  CHECK(fit(from, to).rotation.isIdentity(0.0));
  CHECK(fit(from, to).translation == Eigen::Vector3d(3, 2, 1));
  CHECK(RigidFit().motion().rotation.isIdentity(0.0));

  // On a line: from x to y about z, and not about the line as well.
  from.resize(3, 4);
  to.resize(3, 4);
  for (int i = 0; i < 4; ++i) {
    from.col(i) << i, 0, 0;
    to.col(i) << 0, i, 0;
  }
  CHECK((fit(from, to).rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm() < 1e-14);
}

TEST_CASE("points that stay are fitted by the identity, exactly") {
  test::Random random(4);
  const Points points = random.vector(3 * 50).reshaped(3, 50);
  CHECK(fit(points, points).rotation.isIdentity(0.0));
  CHECK(fit(points, points).translation.isZero(0.0));
}

TEST_CASE("a fit knows the centres of both sets") {
  RigidFit fit;
  CHECK(fit.from_center().isZero(0.0));
  fit.add({1, 2, 3}, {0, 0, 1});
  fit.add({3, 2, 5}, {2, 0, 3});
  CHECK(fit.from_center() == Eigen::Vector3d(2, 2, 4));
  CHECK(fit.to_center() == Eigen::Vector3d(1, 0, 2));
}

TEST_CASE("of points that do not fit exactly the sum of squares is least") {
  test::Random random(8);
  const Points from = random.vector(60).reshaped(3, 20), to = random.vector(60).reshaped(3, 20);
  const RigidMotion best = fit(from, to);
  const auto error = [&](const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) {
    const Points moved = (rotation_of(turn) * best.rotation * from).colwise() + best.translation;
    return ((moved.colwise() + shift) - to).squaredNorm();
  };
  const double least = error({0, 0, 0}, {0, 0, 0});
  for (int k = 0; k < 20; ++k) CHECK(error(1e-3 * random.vector(3), 1e-3 * random.vector(3)) > least);
}
