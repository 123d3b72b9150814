#include "pliant/deformers/rigid_cells/solver.h"

#include <numbers>

#include <doctest/doctest.h>

#include "pliant/geometry/closest_rotation.h"
#include "support/random.h"

using namespace pliant;
using namespace pliant::cells;

namespace {

/// 20 x 5 x 5 unit cubes, the first layer held, on wish the last one, too.
struct Beam {
  CellModel model;
  std::vector<Freedom> freedom;
  std::vector<CellMotion> motions;
  CellSolver solver;

  explicit Beam(bool both_ends) {
    model.centers.resize(3, 500);
    for (Index i = 0; i < 500; ++i) {
      const Eigen::Vector3i at(i % 20, i / 20 % 5, i / 100);
      model.corners.push_back(at);
      model.centers.col(i) = at.cast<double>() - Eigen::Vector3d(9.5, 2.0, 2.0);
      model.sides.push_back(1.0);
      const bool held = at.x() == 0 || (both_ends && at.x() == 19);
      freedom.push_back(held ? Freedom::held : Freedom::free);
    }
    for (Index i = 0; i < 500; ++i) {
      for (const auto& [axis, step] : {std::pair(0, 1), std::pair(1, 20), std::pair(2, 100)}) {
        if (model.corners[i][axis] == (axis == 0 ? 19 : 4)) continue;
        model.pairs.push_back({i, i + step});
        model.weights.push_back(1.0);
        model.glue.emplace_back(model.centers.col(i), model.centers.col(i + step), 1.0, 1.0, 1.0, 3);
      }
    }
    motions = model.rest();
    solver.set_up(model, freedom);
  }
};

}  // namespace

TEST_CASE("cells collapsed to a point and turned at random all find back (the paper's figure 4)") {
  const double diagonal = std::sqrt(450.0);
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Beam beam(false);
    test::Random random(seed);
    for (Index i = 0; i < 500; ++i) {
      if (beam.freedom[i] == Freedom::held) continue;
      const Eigen::Vector3d turn = std::numbers::pi * random.vector(3);
      beam.motions[i] = {rotation_of(turn), Eigen::Vector3d::Zero()};
    }
    double energy = beam.model.energy(beam.motions);
    int iterations = 0;
    for (; iterations < 100; ++iterations) {
      const auto outcome = beam.solver.step(beam.motions, {});
      REQUIRE(outcome.accepted);
      CHECK(outcome.energy <= energy);
      energy = outcome.energy;
      if (outcome.move < 1e-6 * diagonal) break;
    }
    CHECK(iterations < 100);
    double farthest = 0.0;
    for (Index i = 0; i < 500; ++i) {
      farthest = std::max(farthest, (beam.motions[i].center - beam.model.centers.col(i)).norm());
    }
    CHECK(farthest < 1e-4 * diagonal);
  }
}

TEST_CASE("a twist of 90 degrees from rest takes at most 12 iterations") {
  Beam beam(true);
  const Eigen::Matrix3d turn = rotation_of({std::numbers::pi / 2.0, 0, 0});
  for (Index i = 0; i < 500; ++i) {
    if (beam.model.corners[i].x() == 19) beam.motions[i] = {turn, turn * beam.model.centers.col(i)};
  }
  int iterations = 0;
  for (bool settled = false; !settled && iterations < 50; ++iterations) {
    const auto outcome = beam.solver.step(beam.motions, {});
    REQUIRE(outcome.accepted);
    settled = outcome.decrease < 1e-6 && outcome.move < 1e-6 * std::sqrt(450.0);
  }
  CAPTURE(iterations);
  CHECK(iterations <= 12);
  // It is twisted evenly: the middle by half of it.
  const Eigen::Vector3d half = rotation_vector_of(beam.motions[9 + 2 * 20 + 2 * 100].rotation);
  CHECK(half.x() == doctest::Approx(std::numbers::pi / 2.0 * 9.0 / 19.0).epsilon(0.02));
}
