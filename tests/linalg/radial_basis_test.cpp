#include "pliant/linalg/radial_basis.h"

#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

namespace {

double cubed(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::pow((a - b).norm(), 3); }

/// The textbook's system: kernel and polynomials, solved by LU.
Eigen::VectorXd textbook(const Points& centers, const Eigen::Vector3d& place) {
  const Index n = static_cast<Index>(centers.cols());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
  Eigen::VectorXd right(n + 4);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) system(i, j) = cubed(centers.col(i), centers.col(j));
    system.block<1, 4>(i, n) << 1.0, centers.col(i).transpose();
    system.block<4, 1>(n, i) = system.block<1, 4>(i, n).transpose();
    right[i] = cubed(centers.col(i), place);
  }
  right.tail<4>() << 1.0, place;
  return system.fullPivLu().solve(right).head(n);
}

const Eigen::VectorXd kOne = Eigen::VectorXd::Ones(1);

}  // namespace

TEST_CASE("weights are those of the full system of kernels and polynomials") {
  test::Random random(7);
  const Points centers = random.vector(150).reshaped(3, 50);
  RadialBasis basis(centers);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d place = random.vector(3);
    CHECK((basis.weights(place, kOne) - textbook(centers, place)).norm() < 1e-9);
  }
}

TEST_CASE("values at centres are met, linear functions reproduced, also of flat, straight and few centres") {
  test::Random random(9);
  for (const int flat : {0, 1, 2}) {
    for (const int count : {1, 2, 3, 4, 5, 40}) {
      CAPTURE(flat);
      CAPTURE(count);
      // In a plane or on a line that is no coordinate's.
      const Eigen::Matrix3d directions = random.vector(9).reshaped(3, 3);
      // Apart by at least half a step along the first direction: centres that nearly coincide are another matter.
      Points along = random.vector(3 * count).reshaped(3, count);
      for (int k = 0; k < count; ++k) along(0, k) = (k + 0.25 * along(0, k)) * 2.0 / count - 1.0;
      along.bottomRows(flat).setZero();
      const Points centers = directions * along;
      RadialBasis basis(centers);
      REQUIRE(basis.size() == count);
      for (int k = 0; k < count; ++k) {
        CHECK((basis.weights(centers.col(k), kOne) - Eigen::VectorXd::Unit(count, k)).norm() < 1e-5);
      }
      if (count < 4 - flat) continue;
      Eigen::Vector3d at = random.vector(3);
      at.tail(flat).setZero();
      const Eigen::Vector3d place = directions * at;
      const Eigen::VectorXd weights = basis.weights(place, kOne);
      CHECK(weights.sum() == doctest::Approx(1.0).epsilon(1e-9));
      CHECK((centers * weights - place).norm() < 1e-8);
    }
  }
}

TEST_CASE("weights of several places are the sum of theirs times the factors") {
  test::Random random(13);
  const Points centers = random.vector(90).reshaped(3, 30);
  RadialBasis basis(centers);
  const Points places = random.vector(9).reshaped(3, 3);
  const Eigen::Vector3d factors(2.0, -0.5, 0.25);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(30);
  for (int p = 0; p < 3; ++p) sum += factors[p] * basis.weights(places.col(p), kOne);
  CHECK((basis.weights(places, factors) - sum).norm() < 1e-10);
}
