#include "pliant/deformers/arap/model.h"

#include <doctest/doctest.h>

#include "deformers/arap/reference.h"
#include "support/derivatives.h"
#include "support/local_models.h"
#include "support/random.h"
#include "support/shapes.h"

using namespace pliant;

namespace {

Points shaken(const Points& points, double by, bool planar = false) {
  test::Random random(7);
  Points x = points;
  for (double& v : x.reshaped()) v += by * random.number();
  if (planar) x.row(2).setZero();
  return x;
}

}  // namespace

TEST_CASE("law 7: the gradient of every ARAP energy agrees with central differences") {
  const auto shape = test::shape_of(test::potato(1));
  for (const ArapOptions& options :
       {ArapOptions{}, ArapOptions{.energy = ArapEnergy::spokes_and_rims}, ArapOptions{.smoothness = 0.2}}) {
    arap::ArapModel model(*shape, options);
    const Points x = shaken(shape->points(), 0.1);
    Points half_gradient, unused;
    model.evaluate(x, half_gradient);
    const auto energy = [&](const Eigen::VectorXd& at) {
      return model.evaluate(at.reshaped(3, at.size() / 3), unused);
    };
    const Eigen::VectorXd expected = test::central_differences(energy, x.reshaped());
    CHECK((2.0 * half_gradient.reshaped() - expected).norm() < 1e-6 * expected.norm());
  }
}

TEST_CASE("ARAP: the energy is the one of the plain formula") {
  for (const auto& mesh : {test::potato(2), test::plane_grid(7, 5), test::tube(9, 6)}) {
    const auto shape = test::shape_of(mesh);
    const Points x = shaken(shape->points(), 0.2);
    for (bool rims : {false, true}) {
      arap::ArapModel model(*shape, {.energy = rims ? ArapEnergy::spokes_and_rims : ArapEnergy::spokes});
      Points unused;
      std::vector<Eigen::Matrix3d> rotations;
      CHECK(model.evaluate(x, unused) ==
            doctest::Approx(test::ArapReference(*shape, rims).energy(x, rotations)).epsilon(1e-9));
    }
  }
}

TEST_CASE("ARAP: the matrix is the second derivative at fixed rotations") {
  const auto shape = test::shape_of(test::potato(1));
  for (double smoothness : {0.0, 0.3}) {
    const arap::ArapModel model(*shape, {.smoothness = smoothness});
    // Not to the last digit: the matrix is a metric and keeps edges without weight from floating.
    test::check_matrix_is_second_derivative(model, shaken(shape->points(), 1.0), 1e-5);
  }
}
