#include "pliant/geometry/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/shapes.h"

namespace pliant {
namespace {

using Coordinates = std::vector<double>;
using Ids = std::vector<std::uint32_t>;

void check_refused(const Coordinates& positions, const Ids& triangles, int dimension, const std::string& message) {
  const auto shape = Shape::create(positions, triangles, dimension);
  REQUIRE(!shape.ok());
  CHECK(shape.status().code() == ErrorCode::invalid_shape);
  CHECK(shape.status().message() == message);
}

TEST_CASE("the door refuses what is not a shape, and says why") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  check_refused({}, {}, 3, "positions is empty; expected at least one vertex");
  check_refused({0, 0}, {}, 3, "positions has length 2; expected a multiple of 3");
  check_refused({0, 0, 0}, {}, 2, "positions has length 3; expected a multiple of 2");
  check_refused({0, 0, 0}, {}, 4, "dimension is 4; expected 2 or 3");
  check_refused({0, 0, 0, 0, nan, 0}, {}, 3, "positions[4] is NaN; expected a finite number");
  check_refused({-infinity, 0, 0}, {}, 3, "positions[0] is -Infinity; expected a finite number");
  check_refused({0, 2e30, 0}, {}, 3, "positions[1] is 2e+30; expected a magnitude of at most 1e+30");
  check_refused({0, 0, 0, 0, 0, 1e-31}, {}, 3, "positions span 1e-31; expected at least 1e-30, or one position only");
  check_refused({0, 0, 0}, {0, 0}, 3, "triangles has length 2; expected a multiple of 3");
  check_refused({0, 0, 0}, {0, 0, 1}, 3, "triangles[2] is 1; expected a vertex id below 1");
  check_refused({0, 0, 0}, {0, 4294967295u, 0}, 3, "triangles[1] is 4294967295; expected a vertex id below 1");
}

TEST_CASE("equal positions become one point, -0 is 0, results go back to every vertex") {
  const auto shape = Shape::create(Coordinates{1, 0, 0, 0, 1, 0, 1, -0.0, 0, 0, 0, 1}, Ids{2, 1, 3});
  REQUIRE(shape.ok());
  const Shape& s = **shape;
  CHECK(s.input_size() == 4);
  CHECK(s.points().cols() == 3);
  CHECK(s.point_of_vertex() == std::vector<Index>{0, 1, 0, 2});
  CHECK(s.vertex_of_point() == std::vector<Index>{0, 1, 3});
  CHECK(s.triangles().col(0) == Eigen::Matrix<Index, 3, 1>(0, 1, 2));
  CHECK(s.report().welded_vertices == 1);
  Points values(3, 3);
  values << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const Points scattered = s.scatter(values);
  REQUIRE(scattered.cols() == 4);
  CHECK(scattered.col(2) == values.col(0));
  CHECK(scattered.col(3) == values.col(2));
}

TEST_CASE("positions a rounding apart stay two points") {
  const double above = std::nextafter(1.0, 2.0);
  const auto shape = Shape::create(Coordinates{1, 0, 0, above, 0, 0, 2, 0, 0}, {});
  REQUIRE(shape.ok());
  CHECK((*shape)->points().cols() == 3);
}

TEST_CASE("the plane gets z = 0") {
  const auto shape = Shape::create(Coordinates{0, 0, 3, 0, 0, 4}, Ids{0, 1, 2}, 2);
  REQUIRE(shape.ok());
  CHECK((*shape)->dimension() == 2);
  CHECK((*shape)->diagonal() == 5.0);
  CHECK((*shape)->points().row(2).isZero(0.0));
  CHECK((*shape)->normals().col(1) == Eigen::Vector3d(0, 0, 1));
}

TEST_CASE("one position only has no diagonal and is still a shape") {
  const auto shape = Shape::create(Coordinates{5, 5, 5, 5, 5, 5, 5, 5, 5}, Ids{0, 1, 2});
  REQUIRE(shape.ok());
  CHECK((*shape)->diagonal() == 0.0);
  CHECK((*shape)->points().cols() == 1);
  CHECK((*shape)->triangles().cols() == 0);
  CHECK((*shape)->report().degenerate_triangles == 1);
}

TEST_CASE("reports agree with Euler's formula and with the way the shapes are built") {
  const ShapeReport plane = test::shape_of(test::plane_grid(7, 5))->report();
  CHECK(plane.vertices == 35);
  CHECK(plane.triangles == 48);
  CHECK(plane.components == 1);
  CHECK(plane.boundary_edges == 20);
  CHECK(plane.non_manifold_edges == 0);

  const ShapeReport tube = test::shape_of(test::tube(9, 4))->report();
  CHECK(tube.boundary_edges == 18);
  CHECK(tube.components == 1);

  for (const test::Mesh& closed : {test::sphere(2), test::torus(12, 8), test::box(2, 1, 1, 0.5), test::potato(2)}) {
    const ShapeReport report = test::shape_of(closed)->report();
    CHECK(report.boundary_edges == 0);
    CHECK(report.non_manifold_edges == 0);
    CHECK(report.components == 1);
    CHECK(report.degenerate_triangles == 0);
  }
}

TEST_CASE("a soup is welded back to the mesh it came from") {
  const test::Mesh mesh = test::sphere(1);
  const auto whole = test::shape_of(mesh);
  const auto soup = test::shape_of(test::soup(mesh));
  CHECK(soup->input_size() == static_cast<Index>(mesh.triangles.size()));
  CHECK(soup->points().cols() == whole->points().cols());
  CHECK(soup->report().welded_vertices == soup->input_size() - whole->points().cols());
  CHECK(soup->report().boundary_edges == 0);
  CHECK(soup->report().components == 1);
}

TEST_CASE("components, fins and isolated points are counted") {
  test::Mesh mesh = test::both(test::sphere(0), test::plane_grid(2, 2, 5.0, 5.0));
  CHECK(test::shape_of(mesh)->report().components == 2);
  mesh.positions.insert(mesh.positions.end(), {9, 9, 9});
  CHECK(test::shape_of(mesh)->report().components == 3);
  // A third triangle on the plane's diagonal (vertices 12 and 15), up to the isolated point.
  mesh.triangles.insert(mesh.triangles.end(), {12, 15, 16});
  const ShapeReport report = test::shape_of(mesh)->report();
  CHECK(report.components == 2);
  CHECK(report.non_manifold_edges == 1);
  CHECK(report.boundary_edges == 6);
}

TEST_CASE("triangles without area are counted; only those with repeated points are left out") {
  const Coordinates positions = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1e-14, 0, 1, 0, 0};
  // Sound, on a line, a sliver below rounding, a repeated id, a repeated position.
  const Ids triangles = {0, 1, 3, 0, 1, 2, 0, 4, 2, 0, 0, 3, 1, 5, 3};
  const auto shape = Shape::create(positions, triangles);
  REQUIRE(shape.ok());
  CHECK((*shape)->report().triangles == 5);
  CHECK((*shape)->report().degenerate_triangles == 4);
  CHECK((*shape)->triangles().cols() == 3);
}

TEST_CASE("no area is judged relative to the size") {
  for (const double scale : {1e-25, 1.0, 1e25}) {
    const test::Mesh mesh = test::transformed(test::potato(3), scale);
    CHECK(test::shape_of(mesh)->report().degenerate_triangles == 0);
  }
}

TEST_CASE("normals of a sphere are its points; where there is no triangle they are zero") {
  test::Mesh mesh = test::sphere(3);
  mesh.positions.insert(mesh.positions.end(), {0, 0, 0});
  const auto shape = test::shape_of(mesh);
  const Points normals = shape->normals();
  const Index last = static_cast<Index>(normals.cols()) - 1;
  CHECK(normals.col(last).isZero(0.0));
  CHECK((normals - shape->points()).colwise().norm().maxCoeff() < 0.02);
  CHECK((normals.leftCols(last).colwise().norm().array() - 1.0).abs().maxCoeff() < 1e-14);
}

TEST_CASE("in local order it is the same shape, with edges that reach less far in memory") {
  // The same triangles, by their first vertices.
  const auto triangles_of = [](const Shape& of) {
    std::vector<std::array<Index, 3>> triangles;
    for (const auto& corners : of.triangles().colwise()) {
      triangles.push_back(
          {of.vertex_of_point()[corners[0]], of.vertex_of_point()[corners[1]], of.vertex_of_point()[corners[2]]});
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  const auto reach = [](const Shape& of) {
    const Triangles& t = of.triangles();
    return (t.row(0) - t.row(1)).cwiseAbs().cast<double>().mean();
  };
  const test::Mesh scattered = test::renumbered(test::torus(40, 20), 7);
  for (const test::Mesh& mesh : {scattered, test::soup(scattered)}) {
    const auto shape = test::shape_of(mesh);
    const auto local = shape->in_local_order();
    CHECK(local->scatter(local->points()) == shape->scatter(shape->points()));
    for (Index p = 0; p < local->points().cols(); ++p)
      CHECK(local->point_of_vertex()[local->vertex_of_point()[p]] == p);
    CHECK(triangles_of(*local) == triangles_of(*shape));
    if (shape->report().welded_vertices == 0) CHECK(reach(*local) < 0.2 * reach(*shape));
  }
}

}  // namespace
}  // namespace pliant
