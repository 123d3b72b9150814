#include "pliant/deformers/edge_material/field.h"

#include <cmath>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/shapes.h"

using namespace pliant;
using Kind = DirectionField::Kind;

namespace {

Points field_of(const test::Mesh& mesh, const DirectionField& field) {
  auto result = edge_material::direction_field(*test::shape_of(mesh), field);
  REQUIRE(result.ok());
  return *result;
}

/// |cos| of the angle between a direction of the field and another.
double agreement(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::abs(a.dot(b)) / b.norm(); }

Points polyline(std::initializer_list<Eigen::Vector3d> points) {
  Points line(3, static_cast<Index>(points.size()));
  Index i = 0;
  for (const auto& p : points) line.col(i++) = p;
  return line;
}

}  // namespace

TEST_CASE("direction field: one stroke gives its direction everywhere on a plane") {
  const auto mesh = test::plane_grid(15, 15);
  const Points field =
      field_of(mesh, {.kind = Kind::strokes, .strokes = {polyline({{0.2, 0.2, 0.01}, {0.5, 0.35, 0}})}});
  for (Index p = 0; p < field.cols(); ++p) CHECK(agreement(field.col(p), {2, 1, 0}) > 1 - 1e-9);
}

TEST_CASE("direction field: strokes meet halfway, and the way they were drawn does not matter") {
  const auto mesh = test::plane_grid(21, 21);
  for (double sign : {1.0, -1.0}) {
    const Points field = field_of(mesh, {.kind = Kind::strokes,
                                         .strokes = {polyline({{0, 0, 0}, {0, 1, 0}}),
                                                     polyline({{1, 0.5 - 0.5 * sign, 0}, {1, 0.5 + 0.5 * sign, 0}})}});
    CHECK(agreement(field.col(10 * 21 + 10), {0, 1, 0}) > 1 - 1e-9);
    const Points turning =
        field_of(mesh, {.kind = Kind::strokes,
                        .strokes = {polyline({{0, 0, 0}, {0, 1, 0}}),
                                    polyline({{1, 0.4, 0}, {1 + sign * 1e-3, 0.4 + sign * 1e-3, 0}})}});
    CHECK(agreement(turning.col(10 * 21 + 19), {1, 1, 0}) > 0.9);
  }
}

TEST_CASE("direction field: a part without strokes has no direction") {
  const auto mesh = test::both(test::plane_grid(5, 5),
                               test::transformed(test::plane_grid(5, 5), 1.0, Eigen::Matrix3d::Identity(), {0, 0, 1}));
  const Points field = field_of(mesh, {.kind = Kind::strokes, .strokes = {polyline({{0, 0, 0}, {1, 0, 0}})}});
  CHECK(field.rightCols(25).isZero(0.0));
  CHECK(field.leftCols(25).colwise().norm().minCoeff() > 1 - 1e-12);
}

TEST_CASE("direction field: an axis lies in the surface, and is nothing where it leaves it") {
  const auto mesh = test::sphere(3);
  const Points field = field_of(mesh, {.kind = Kind::axis, .axis = {0, 0, 3}});
  const auto shape = test::shape_of(mesh);
  const Points normals = shape->normals();
  for (Index p = 0; p < field.cols(); ++p) {
    const double length = field.col(p).norm();
    CHECK((length == 0.0 || length == doctest::Approx(1.0)));
    CHECK(std::abs(field.col(p).dot(normals.col(p))) < 1e-12);
  }
  CHECK(field_of(test::plane_grid(4, 4), {.kind = Kind::axis, .axis = {0, 0, 1}}).isZero(0.0));
}

TEST_CASE("direction field: curvature of a tube runs around and along, a plane has none") {
  const auto mesh = test::tube(40, 30, 1.0, 4.0);
  const Points around = field_of(mesh, {.kind = Kind::curvature_max});
  const Points along = field_of(mesh, {.kind = Kind::curvature_min});
  for (Index p = 40 * 3; p < 40 * 27; ++p) {
    CHECK(agreement(along.col(p), {0, 0, 1}) > 0.99);
    CHECK(std::abs(around.col(p).z()) < 0.1);
  }
  CHECK(field_of(test::plane_grid(6, 6), {.kind = Kind::curvature_max}).isZero(0.0));
}

TEST_CASE("direction field: shortest paths lead away from their sources") {
  const auto mesh = test::plane_grid(41, 41);
  const Points field = field_of(mesh, {.kind = Kind::geodesic, .sources = {0}});
  CHECK(field.col(0).isZero(0.0));
  for (Index p = 0; p < field.cols(); ++p) {
    const Eigen::Vector3d v = mesh.vertex(p);
    // Near a boundary heat flows along it.
    if (v.norm() > 0.2 && v.maxCoeff() < 0.85) CHECK(agreement(field.col(p), v) > 0.95);
  }
}
