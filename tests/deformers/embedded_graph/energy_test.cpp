#include "pliant/deformers/embedded_graph/energy.h"

#include <doctest/doctest.h>

#include "support/derivatives.h"
#include "support/random.h"
#include "support/shapes.h"

using namespace pliant;
using embedded::GraphEnergy;
using embedded::Quartic;
using embedded::Vector;

namespace {

/// A small graph with one frozen node and three constrained points, away from rest.
struct Scene {
  std::shared_ptr<const Shape> shape = test::shape_of(test::potato(2));
  DeformationGraph graph;
  std::vector<bool> frozen = std::vector<bool>(12, false);
  Points constrained, targets;
  GraphEnergy energy;
  Vector x;

  Scene() {
    const EmbeddedGraphOptions options{.node_count = 12};
    graph = build_graph(*shape, *place_nodes(*shape, options), options);
    frozen[3] = true;
    constrained = graph.scaled(shape->points()(Eigen::all, std::vector<Index>{4, 50, 90}));
    Influences some = compute_influences(*shape, graph, shape->points()(Eigen::all, std::vector<Index>{4, 50, 90}));
    energy.set_up(graph, frozen, constrained, some, {.rotation = 1.3, .regularization = 7.0, .constraint = 90.0});
    targets = test::Random(8).vector(9).reshaped(3, 3);
    energy.constraints().set_targets(targets);
    x = 0.3 * test::Random(2).vector(3 * energy.rows());
    energy.evaluate(x);
  }
};

/// Eq. 5-9 as printed, from full transformations: the slow oracle. Returns the three terms.
Eigen::Vector3d slow_terms(const Scene& s, const Vector& x) {
  const Index m = s.graph.size();
  std::vector<Eigen::Matrix3d> R(m, Eigen::Matrix3d::Identity());
  Points t = Points::Zero(3, m);
  const Points g = s.graph.scaled(s.graph.nodes);
  for (Index f = 0; f < s.energy.free_nodes(); ++f) {
    R[s.energy.node_of_free()[f]] += s.energy.displacement_gradient(x, f);
    t.col(s.energy.node_of_free()[f]) = s.energy.translation(x, f);
  }
  Eigen::Vector3d terms = Eigen::Vector3d::Zero();
  for (Index j = 0; j < m; ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int b = a + 1; b < 3; ++b) terms[0] += std::pow(R[j].col(a).dot(R[j].col(b)), 2);
      terms[0] += std::pow(R[j].col(a).squaredNorm() - 1.0, 2);
    }
  }
  for (const auto& edge : s.graph.edges) {
    for (int way = 0; way < 2; ++way) {
      const Index j = edge[way], k = edge[1 - way];
      terms[1] += (R[j] * (g.col(k) - g.col(j)) + g.col(j) + t.col(j) - (g.col(k) + t.col(k))).squaredNorm();
    }
  }
  const Influences influences =
      compute_influences(*s.shape, s.graph, s.shape->points()(Eigen::all, std::vector<Index>{4, 50, 90}));
  for (Index l = 0; l < 3; ++l) {
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    for (int q = 0; q < influences.k; ++q) {
      const Index j = influences.indices[l * influences.k + q];
      v += influences.weights[l * influences.k + q] * (R[j] * (s.constrained.col(l) - g.col(j)) + g.col(j) + t.col(j));
    }
    terms[2] += (v - (s.constrained.col(l) + s.targets.col(l))).squaredNorm();
  }
  return terms;
}

double total_at(const Scene& s, const Vector& x) {
  GraphEnergy copy = s.energy;
  copy.evaluate(x);
  return copy.total();
}

}  // namespace

TEST_CASE("the three terms are those of eq. 5 to 8") {
  const Scene s;
  const Eigen::Vector3d slow = slow_terms(s, s.x);
  CHECK(s.energy.terms().rotation == doctest::Approx(slow[0]).epsilon(1e-12));
  CHECK(s.energy.terms().regularization == doctest::Approx(slow[1]).epsilon(1e-12));
  CHECK(s.energy.terms().constraint == doctest::Approx(slow[2]).epsilon(1e-12));
  CHECK(s.energy.total() == doctest::Approx(1.3 * slow[0] + 7.0 * slow[1] + 90.0 * slow[2]));
}

TEST_CASE("at rest every term and the gradient are exactly zero") {
  Scene s;
  s.energy.constraints().set_targets(Points::Zero(3, 3));
  const Vector rest = Vector::Zero(s.x.size());
  s.energy.evaluate(rest);
  CHECK(s.energy.total() == 0.0);
  Vector gradient;
  s.energy.half_gradient(rest, gradient);
  CHECK(gradient.lpNorm<Eigen::Infinity>() == 0.0);
}

TEST_CASE("the gradient agrees with central differences") {
  const Scene s;
  Vector gradient;
  s.energy.half_gradient(s.x, gradient);
  const Vector numeric = test::central_differences([&](const Vector& x) { return total_at(s, x); }, s.x);
  CHECK((2.0 * gradient - numeric).norm() < 1e-7 * numeric.norm());
}

TEST_CASE("the course along a direction is the energy, and advancing is evaluating") {
  Scene s;
  const Vector d = test::Random(6).vector(s.x.size());
  const Quartic course = s.energy.along(s.x, d);
  for (double alpha : {-0.7, 0.0, 0.3, 1.0, 2.5}) {
    CHECK(course.value(alpha) == doctest::Approx(total_at(s, s.x + alpha * d)).epsilon(1e-11));
  }
  const Vector moved = s.x + 0.4 * d;
  s.energy.advance(0.4, moved);
  CHECK(s.energy.total() == doctest::Approx(total_at(s, moved)).epsilon(1e-12));
}

TEST_CASE("the first minimum of a course is a minimum and the first") {
  // (a - 1)^2 (a - 3)^2: minima at 1 and 3, seen from 0.
  const Quartic two_wells{{9.0, -24.0, 22.0, -8.0, 1.0}};
  CHECK(two_wells.first_minimum() == doctest::Approx(1.0).epsilon(1e-9));
  const Quartic parabola{{5.0, -4.0, 1.0, 0.0, 0.0}};
  CHECK(parabola.first_minimum() == doctest::Approx(2.0));
  CHECK(Quartic{{1.0, 2.0, 1.0, 0.0, 0.0}}.first_minimum() == 0.0);  // rises
  CHECK(Quartic{{1.0, 0.0, 0.0, 0.0, 0.0}}.first_minimum() == 0.0);  // flat
}

TEST_CASE("the Gauss-Newton matrix is J'J of the residuals") {
  const Scene s;
  BlockMatrix constant, matrix;
  s.energy.constant_matrix(constant);
  s.energy.gauss_newton_matrix(s.x, constant, matrix);
  // J'J along d is the squared norm of J d: the quartic's parts that are squares of first
  // derivatives. At a point, d' (J'J) d = (second derivative of F - sum of f f'') / 2, so compare
  // through the linear residuals' energy and the conditions, one direction at a time.
  const Vector d = test::Random(12).vector(s.x.size());
  GraphEnergy energy = s.energy;
  const double h = 1e-6;
  auto residuals = [&](const Vector& x) {
    energy.evaluate(x);
    std::vector<double> rotation, regularization;
    Eigen::VectorXd f(6 * energy.free_nodes());
    for (Index j = 0; j < energy.free_nodes(); ++j) {
      const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + energy.displacement_gradient(x, j);
      f.segment<6>(6 * j) << r.col(0).dot(r.col(1)), r.col(0).dot(r.col(2)), r.col(1).dot(r.col(2)),
          r.col(0).squaredNorm(), r.col(1).squaredNorm(), r.col(2).squaredNorm();
    }
    return f;
  };
  const double rotation_part = 1.3 * ((residuals(s.x + h * d) - residuals(s.x - h * d)) / (2.0 * h)).squaredNorm();
  GraphEnergy linear = s.energy;
  const Quartic course = linear.along(s.x, d);
  // Without E_rot the course is a parabola whose c[2] is |J d|^2: take the difference of two
  // weights.
  GraphEnergy quadratic;
  quadratic.set_up(s.graph, s.frozen, s.constrained,
                   compute_influences(*s.shape, s.graph, s.shape->points()(Eigen::all, std::vector<Index>{4, 50, 90})),
                   {.rotation = 0.0, .regularization = 7.0, .constraint = 90.0});
  quadratic.evaluate(s.x);
  const double quadratic_part = quadratic.along(s.x, d).c[2];
  double through_matrix = 0.0;
  auto of_node = [&](Index j) {
    Eigen::Matrix<double, 12, 1> v;
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) v[4 * a + c] = s.energy.entry(d, a, j)[c];
    }
    return v;
  };
  using Block = Eigen::Matrix<double, 12, 12>;
  for (Index j = 0; j < matrix.nodes; ++j) {
    through_matrix += of_node(j).dot(Eigen::Map<const Block>(matrix.diagonal_block(j)) * of_node(j));
  }
  for (std::size_t e = 0; e < matrix.edges.size(); ++e) {
    const auto [j, k] = matrix.edges[e];
    through_matrix += 2.0 * of_node(k).dot(Eigen::Map<const Block>(matrix.edge_block(e)) * of_node(j));
  }
  CHECK(through_matrix == doctest::Approx(quadratic_part + rotation_part).epsilon(1e-7));
  CHECK(course.c[2] > quadratic_part);  // E_rot adds curvature here
}

TEST_CASE("terms of the nodes add up to the terms") {
  const Scene s;
  std::vector<double> rotation, regularization;
  s.energy.node_terms(s.x, rotation, regularization);
  double sum = 0.0;
  for (double r : rotation) sum += r;
  CHECK(sum == doctest::Approx(s.energy.terms().rotation));
  CHECK(rotation[3] == 0.0);  // frozen
  const std::vector<double> energies = s.energy.node_energies(s.x);
  const auto& w = s.energy.weights();
  for (std::size_t j = 0; j < energies.size(); ++j) {
    CHECK(energies[j] == w.rotation * rotation[j] + w.regularization * regularization[j]);
  }
}
