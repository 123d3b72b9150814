#include "pliant/deformers/edge_material/model.h"

#include <cmath>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/derivatives.h"
#include "support/local_models.h"
#include "support/random.h"
#include "support/shapes.h"

using namespace pliant;
using edge_material::EdgeElement;
using edge_material::EdgeMaterialModel;

namespace {

Points shaken(const Points& points, double by) {
  test::Random random(7);
  Points x = points;
  for (double& v : x.reshaped()) v += by * random.number();
  return x;
}

/// Two triangles over the edge from (0,0,0) to (0,1,0), their wings raised by `angle`.
test::Mesh hinge(double angle, double width = 1.0, double shift = 0.5) {
  const double c = width * std::cos(angle), s = width * std::sin(angle);
  return {{0, 0, 0, 0, 1, 0, -c, shift, s, c, shift, s}, {0, 1, 2, 1, 0, 3}};
}

const EdgeElement& bending_element(const EdgeMaterialModel& model) {
  for (const EdgeElement& e : model.elements()) {
    if (e.l >= 0) return e;
  }
  FAIL("there is no hinge");
  return model.elements().front();
}

}  // namespace

TEST_CASE("edge material: sigma is the signed distance of the edge from the line across it") {
  for (double angle : {0.0, 0.4, -0.4, 1.2}) {
    for (bool turned_over : {false, true}) {
      test::Mesh mesh = hinge(angle);
      if (turned_over) {
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t], mesh.triangles[t + 1]);
      }
      const EdgeMaterialModel model(*test::shape_of(mesh));
      const EdgeElement& e = bending_element(model);
      CHECK(e.alpha == doctest::Approx(0.5));
      CHECK(e.beta == doctest::Approx(0.5));
      CHECK(e.rho == 1.0);
      // The wings of triangle 0 1 2 go counter-clockwise seen from above: a valley is negative.
      CHECK(e.sigma == doctest::Approx((turned_over ? 1.0 : -1.0) * std::sin(angle)));
    }
  }
}

TEST_CASE("edge material: p and q are the feet of the common perpendicular, also off the segments") {
  for (double shift : {0.1, 0.5, 1.7}) {
    test::Mesh mesh = hinge(0.3, 1.0, shift);
    mesh.positions[7] += 0.4;  // no symmetry
    const auto shape = test::shape_of(mesh);
    const EdgeMaterialModel model(*shape);
    const EdgeElement& e = bending_element(model);
    const Points& v = shape->points();
    const Eigen::Vector3d p = e.alpha * v.col(e.i) + (1 - e.alpha) * v.col(e.j);
    const Eigen::Vector3d q = e.beta * v.col(e.l) + (1 - e.beta) * v.col(e.m);
    CHECK((p - q).dot(v.col(e.i) - v.col(e.j)) == doctest::Approx(0.0));
    CHECK((p - q).dot(v.col(e.l) - v.col(e.m)) == doctest::Approx(0.0));
    // Eq. 4: the normal is that of the two triangles together.
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (const auto t : shape->triangles().colwise()) {
      area += (v.col(t[1]) - v.col(t[0])).cross(v.col(t[2]) - v.col(t[0]));
    }
    CHECK((e.sigma * area.normalized() - (p - q)).norm() < 1e-12);
  }
}

TEST_CASE("edge material: boundary edges only stretch, fins bend with every pair, slivers do not") {
  const EdgeMaterialModel one(*test::shape_of({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}));
  REQUIRE(one.elements().size() == 3);
  for (const EdgeElement& e : one.elements()) CHECK(e.l == -1);

  test::Mesh fins = hinge(0.2);
  fins.positions.insert(fins.positions.end(), {0.1, 0.4, 1});
  fins.triangles.insert(fins.triangles.end(), {0, 1, 4});
  const EdgeMaterialModel three(*test::shape_of(fins));
  int pairs = 0;
  for (const EdgeElement& e : three.elements()) pairs += e.l >= 0;
  CHECK(pairs == 3);

  // The line across runs along the edge.
  const EdgeMaterialModel sliver(*test::shape_of({{0, 0, 0, 0, 1, 0, -1e-3, -3, 0, 1e-3, 4, 0}, {0, 1, 2, 1, 0, 3}}));
  for (const EdgeElement& e : sliver.elements()) CHECK(e.l == -1);
}

TEST_CASE("law 7: the gradient of edge material agrees with central differences") {
  const auto shape = test::shape_of(test::potato(1));
  EdgeMaterialModel model(*shape);
  Points field(3, shape->points().cols());
  for (Index p = 0; p < field.cols(); ++p)
    field.col(p) = shape->points().col(p).cross(Eigen::Vector3d(0, 0.3, 1)).normalized();
  model.set_field(field);
  for (const auto& [lambda, mu] : {std::pair(1.0, 0.0), std::pair(0.0, 1.0), std::pair(0.3, 0.7)}) {
    model.set_weights({lambda, mu, 0.8, 0.6, Eigen::Vector3d(0.1, -0.2, 0.3)});
    const Points x = shaken(shape->points(), 0.1);
    Points half_gradient, unused;
    const double total = model.evaluate(x, half_gradient);
    CHECK(total == doctest::Approx(0.8 * lambda * model.stretch() + 0.6 * mu * model.bend() + model.gravity()));
    const auto energy = [&](const Eigen::VectorXd& at) {
      return model.evaluate(at.reshaped(3, at.size() / 3), unused);
    };
    const Eigen::VectorXd expected = test::central_differences(energy, x.reshaped());
    CHECK((2.0 * half_gradient.reshaped() - expected).norm() < 1e-6 * expected.norm());
  }
}

TEST_CASE("edge material: a fold keeps the previous normal and finite forces") {
  const auto shape = test::shape_of(hinge(0.3));
  EdgeMaterialModel model(*shape);
  Points x = shape->points(), half_gradient;
  x.col(3) = x.col(2);  // one wing onto the other
  CHECK(std::isfinite(model.evaluate(x, half_gradient)));
  CHECK(half_gradient.allFinite());
}

TEST_CASE("edge material: kappa follows eq. 13, knows no sign and is 1 where there is no direction") {
  const auto shape = test::shape_of(test::plane_grid(5, 5));
  EdgeMaterialModel model(*shape);
  Points field = Points::Zero(3, 25);
  for (Index p = 0; p < 20; ++p) field(0, p) = p % 2 == 0 ? 1.0 : -1.0;  // along x, either way
  model.set_field(field);
  for (const EdgeElement& e : model.elements()) {
    const Eigen::Vector3d edge = shape->points().col(e.i) - shape->points().col(e.j);
    const bool nowhere = e.i >= 20 && e.j >= 20;
    const double kappa = nowhere ? 1.0 : std::abs(edge.x()) / edge.norm();
    CHECK(e.kappa == doctest::Approx(0.01 + 0.99 * kappa));
  }
}

TEST_CASE("edge material: the matrix is the second derivative with normals and directions fixed") {
  const auto shape = test::shape_of(test::potato(1));
  EdgeMaterialModel model(*shape);
  model.set_weights({.lambda = 0.7, .mu = 1.3});
  test::check_matrix_is_second_derivative(model, shaken(shape->points(), 1.0), 1e-12);
}
