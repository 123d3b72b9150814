#include "pliant/deformers/rigid_cells/energy.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/closest_rotation.h"
#include "support/derivatives.h"
#include "support/random.h"

using namespace pliant;
using namespace pliant::cells;

namespace {

struct Cube {
  Eigen::Vector3d center;
  double side;
};

Eigen::Vector3d carried(const CellMotion& motion, const Cube& cube, const Eigen::Vector3d& x) {
  return motion.rotation * (x - cube.center) + motion.center;
}

/// Eq. 1 by Gauss quadrature, exact for polynomials up to the fifth degree.
double quadrature(const Cube& a, const Cube& b, const CellMotion& ta, const CellMotion& tb, int dimension) {
  const double node = std::sqrt(0.6) / 2.0;
  const double at[3] = {-node, 0.0, node}, weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const auto volume = [&](const Cube& cube) { return std::pow(cube.side, dimension); };
  double sum = 0.0;
  for (const Cube& cube : {a, b}) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < (dimension == 3 ? 3 : 1); ++k) {
          const Eigen::Vector3d offset(at[i], at[j], dimension == 3 ? at[k] : 0.0);
          const Eigen::Vector3d x = cube.center + cube.side * offset;
          const double w = weight[i] * weight[j] * (dimension == 3 ? weight[k] : 1.0) * volume(cube);
          sum += w * (carried(ta, a, x) - carried(tb, b, x)).squaredNorm();
        }
      }
    }
  }
  return sum / (volume(a) + volume(b));
}

CellMotion random_motion(test::Random& random, int dimension) {
  CellMotion motion;
  Eigen::Vector3d turn = 2.0 * random.vector(3);
  motion.center = random.vector(3);
  if (dimension == 2) {
    turn.head<2>().setZero();
    motion.center.z() = 0.0;
  }
  motion.rotation = rotation_of(turn);
  return motion;
}

/// Two cubes face to face, and a small one at a quarter of a large one's face.
std::vector<std::pair<Cube, Cube>> neighbours(int dimension) {
  const double z = dimension == 3 ? 0.25 : 0.0;
  return {{{{0, 0, 0}, 1.0}, {{1, 0, 0}, 1.0}},
          {{{0, 0, 0}, 1.0}, {{0.75, -0.25, z}, 0.5}},
          {{{0.3, 2.0, 0.0}, 0.7}, {{0.3, 1.475, 0.0}, 0.35}}};
}

}  // namespace

TEST_CASE("the energy of a pair in closed form is the integral over both cells, across T-junctions, too") {
  test::Random random(21);
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    for (const auto& [a, b] : neighbours(dimension)) {
      for (int i = 0; i < 20; ++i) {
        const CellMotion ta = random_motion(random, dimension), tb = random_motion(random, dimension);
        const Glue glue(a.center, b.center, a.side, b.side, 0.37, dimension);
        const double expected = 0.37 * quadrature(a, b, ta, tb, dimension);
        CHECK(std::abs(glue.energy(ta, tb) - expected) < 1e-10 * expected);
      }
    }
  }
}

TEST_CASE("the linearised energy has the energy's gradient and value") {
  test::Random random(23);
  for (const auto& [a, b] : neighbours(3)) {
    for (int i = 0; i < 10; ++i) {
      const CellMotion ta = random_motion(random, 3), tb = random_motion(random, 3);
      const Glue glue(a.center, b.center, a.side, b.side, 1.3, 3);
      Eigen::VectorXd analytic = Eigen::VectorXd::Zero(12);
      Inertia stiffness;
      const double value = glue.linearize(ta, tb, stiffness, analytic.data(), analytic.data() + 6);
      CHECK(value == doctest::Approx(glue.energy(ta, tb)));
      const auto energy = [&](const Eigen::VectorXd& x) {
        return glue.energy(moved(ta, x.data(), 1.0), moved(tb, x.data() + 6, 1.0));
      };
      const Eigen::VectorXd numeric = test::central_differences(energy, Eigen::VectorXd::Zero(12), 1e-5);
      CHECK((2.0 * analytic - numeric).norm() < 1e-7 * (1.0 + numeric.norm()));
    }
  }
}

TEST_CASE("at rest nothing pulls, exactly, and the form is that of small motions") {
  test::Random random(25);
  for (const auto& [a, b] : neighbours(3)) {
    const Glue glue(a.center, b.center, a.side, b.side, 0.9, 3);
    const CellMotion ta{Eigen::Matrix3d::Identity(), a.center}, tb{Eigen::Matrix3d::Identity(), b.center};
    CHECK(glue.energy(ta, tb) == 0.0);
    Eigen::VectorXd wrench = Eigen::VectorXd::Zero(12);
    Inertia stiffness;
    glue.linearize(ta, tb, stiffness, wrench.data(), wrench.data() + 6);
    CHECK(wrench == Eigen::VectorXd::Zero(12));
    const Eigen::VectorXd twists = 1e-4 * random.vector(12);
    const Eigen::VectorXd difference = twists.head<6>() - twists.tail<6>();
    const double quadratic = difference.dot(stiffness.dense() * difference);
    CHECK(glue.energy(moved(ta, twists.data(), 1.0), moved(tb, twists.data() + 6, 1.0)) ==
          doctest::Approx(quadratic).epsilon(1e-3));
  }
}

TEST_CASE("a cell moved by a twist is where the closest rigid motion of its corners puts it") {
  test::Random random(27);
  const Cube cube{{0.4, -0.2, 0.7}, 0.3};
  for (int i = 0; i < 10; ++i) {
    const CellMotion motion = random_motion(random, 3);
    const Eigen::VectorXd twist = 2.0 * random.vector(6);
    RigidFit fit;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d offset((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
      const Eigen::Vector3d rest = cube.center + cube.side * offset, now = carried(motion, cube, rest);
      fit.add(rest, now + twist.head<3>() + twist.tail<3>().cross(now));
    }
    const CellMotion result = moved(motion, twist.data(), 1.0);
    const RigidMotion closest = fit.motion();
    CHECK((result.rotation - closest.rotation).norm() < 1e-12);
    CHECK((result.center - closest.rotation * cube.center - closest.translation).norm() < 1e-12);
  }
}

TEST_CASE("inertias act as their matrices, and compliances as the inverses") {
  test::Random random(29);
  Inertia inertia;
  for (int i = 0; i < 5; ++i) inertia.add_point(1.0 + 0.5 * random.number(), random.vector(3));
  const Eigen::Matrix<double, 6, 6> matrix = inertia.dense();
  CHECK((matrix - matrix.transpose()).norm() < 1e-14);
  const Eigen::VectorXd wrench = random.vector(6);
  Eigen::VectorXd twist(6);
  Compliance::of_free(inertia).apply(wrench.data(), twist.data());
  CHECK((matrix * twist - wrench).norm() < 1e-9);
  // Turning about a point: twists (-w x p, w) alone, least energy less work among them.
  const Eigen::Vector3d pivot = random.vector(3);
  Eigen::Matrix<double, 6, 3> turning;
  for (int k = 0; k < 3; ++k) turning.col(k) << -Eigen::Vector3d::Unit(k).cross(pivot), Eigen::Vector3d::Unit(k);
  Compliance::about(inertia, pivot).apply(wrench.data(), twist.data());
  const Eigen::Matrix3d reduced = turning.transpose() * matrix * turning;
  const Eigen::VectorXd expected = turning * reduced.ldlt().solve(turning.transpose() * wrench);
  CHECK((twist - expected).norm() < 1e-9);
}
