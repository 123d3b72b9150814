// Refinement, and that the saved state says all: must show 4 of the issue.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/adjacency.h"
#include "pliant/solve/deformation.h"
#include "sketch/sketch_support.h"

namespace pliant {
namespace {

using test::front_pixel;

constexpr double pi = std::numbers::pi;
constexpr int around = 16, along = 40;

/// A tube whose first column of vertices is copied, as a texture's seam would.
test::Mesh seamed_tube() {
  test::Mesh mesh;
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i <= around; ++i) {
      const double a = 2 * pi * (i % around) / around;
      mesh.positions.insert(mesh.positions.end(),
                            {0.05 * std::cos(a), 0.05 * std::sin(a), static_cast<double>(j) / (along - 1)});
    }
  }
  for (std::uint32_t j = 0; j + 1 < along; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * (around + 1) + i, b = a + around + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
  return mesh;
}

Stroke reference() { return test::straight(front_pixel(0.0, 0.1), front_pixel(0.0, 0.9)); }

/// Straight, then half a turn over a fifth of the way, then straight; twice as long.
Stroke long_hook() {
  return test::curved(front_pixel(0.0, 0.1), 1.6, [](double s) { return s > 0.4 && s < 0.6 ? pi / (0.2 * 1.6) : 0.0; });
}

Eigen::Vector3d point_of(const StateTable& table, Index i) {
  return Eigen::Map<const Eigen::Vector3d>(table.data.data() + 3 * i);
}

Eigen::Vector3d on_curve(const StateTable& curve, double s) {
  const Index last = static_cast<Index>(curve.data.size() / 3) - 1;
  const double x = s * last;
  const Index i = std::min(static_cast<Index>(x), last - 1);
  return (1.0 - (x - i)) * point_of(curve, i) + (x - i) * point_of(curve, i + 1);
}

/// Eq. 6 from what a state holds.
Eigen::Vector3d carried(const State& state, const Eigen::Vector3d& v, double s, double angle) {
  const Eigen::AngleAxisd turn(angle, point_of(*state.find("normals"), 0));
  return on_curve(*state.find("target"), s) + turn * (v - on_curve(*state.find("reference"), s));
}

TEST_CASE("the saved state alone recomputes the bend") {
  const test::Mesh mesh = seamed_tube();
  for (const bool smooth : {false, true}) {
    SketchOptions options;
    options.smooth = smooth;
    const auto sketch = test::sketch_on(mesh, reference(), options);
    REQUIRE(sketch->bend(long_hook()).ok());
    const State state = sketch->save();
    const Points bent = sketch->positions();
    REQUIRE(state.find("labels")->data.size() == static_cast<std::size_t>(mesh.vertices()));
    for (Index v = 0; v < mesh.vertices(); ++v) {
      const Eigen::Vector3d expected =
          carried(state, mesh.vertex(v), state.find("s")->data[v], state.find("angles")->data[v]);
      CHECK((bent.col(v) - expected).norm() < 1e-9);
    }
  }
}

TEST_CASE("refinement splits what is stretched and bent, carries attributes, and is undone") {
  const test::Mesh mesh = seamed_tube();
  const auto sketch = test::sketch_on(mesh, reference());
  REQUIRE(sketch->bend(long_hook()).ok());
  const Points before = sketch->positions();
  REQUIRE(sketch->refine(mesh.triangles).ok());
  const Refinement& refined = *sketch->refinement();
  const Points rest = sketch->rest(), bent = sketch->positions();
  const Index n = mesh.vertices(), added = static_cast<Index>(refined.parents.size());
  REQUIRE(added > 20);
  REQUIRE(bent.cols() == n + added);
  CHECK(bent.leftCols(n) == before);

  // Every edge left fails a criterion; the middle is placed from the state.
  const State state = sketch->save();
  const auto& s = state.find("s")->data;
  const auto& angles = state.find("angles")->data;
  const double step = (point_of(*state.find("reference"), 0) - point_of(*state.find("reference"), 1)).norm();
  int stretched = 0;
  for (std::size_t i = 0; i < refined.triangles.size(); ++i) {
    const Index a = static_cast<Index>(refined.triangles[i]);
    const Index b = static_cast<Index>(refined.triangles[i % 3 == 2 ? i - 2 : i + 1]);
    const double stretch = (bent.col(a) - bent.col(b)).norm() / (rest.col(a) - rest.col(b)).norm();
    if (stretch <= 1.5 || (rest.col(a) - rest.col(b)).norm() <= step) continue;
    ++stretched;
    const Eigen::Vector3d middle =
        carried(state, 0.5 * (rest.col(a) + rest.col(b)), 0.5 * (s[a] + s[b]), 0.5 * (angles[a] + angles[b]));
    const Eigen::Vector3d u = bent.col(a) - middle, v = bent.col(b) - middle;
    CHECK(std::atan2(u.cross(v).norm(), u.dot(v)) >= pi - pi / 24 - 1e-9);
  }
  CHECK(stretched > 100);

  // In the bend, where the target turns.
  int in_bend = 0;
  for (Index i = 0; i < added; ++i) in_bend += s[n + i] > 0.35 && s[n + i] < 0.65;
  CHECK(in_bend >= 0.8 * added);

  // Attributes: the middle of the parents'. Rest positions are one, copies at the seam stay one.
  std::vector<double> carried_rest = mesh.positions;
  refined.carry(carried_rest, 3);
  CHECK((Eigen::Map<const Points>(carried_rest.data(), 3, n + added) - rest).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(refined.triangle_parents.size() == refined.triangles.size() / 3);
  const std::vector<double> all(rest.data(), rest.data() + rest.size());
  const auto welded = Shape::create(all, refined.triangles);
  REQUIRE(welded.ok());
  CHECK((*welded)->report().boundary_edges == sketch->shape().report().boundary_edges);
  CHECK((*welded)->report().non_manifold_edges == 0);
  CHECK((*welded)->report().components == 1);
  CHECK((*welded)->report().degenerate_triangles == 0);

  const Points normals = sketch->normals();
  CHECK(normals.cols() == n + added);
  CHECK((normals.colwise().norm().array() - 1.0).abs().maxCoeff() < 1e-12);

  // Later poses move the added vertices with their neighbours.
  REQUIRE(sketch->bend(reference()).ok());
  CHECK((sketch->positions() - rest).cwiseAbs().maxCoeff() < 1e-12);
  REQUIRE(sketch->bend(long_hook()).ok());
  CHECK((sketch->positions() - bent).cwiseAbs().maxCoeff() < 1e-9);

  sketch->unrefine();
  CHECK(sketch->refinement() == nullptr);
  CHECK(sketch->positions() == before);
  CHECK(sketch->save().find("parents") == nullptr);
}

TEST_CASE("refinement ends, also where the target kinks and where the skinning jumps") {
  for (const auto& [rings, columns] :
       {std::array{12, 30}, std::array{18, 20}, std::array{20, 18}, std::array{24, 15}}) {
    const test::Mesh mesh = test::cylinder(rings, columns, 0.06);
    REQUIRE(mesh.vertices() == 362);
    for (const double longer : {1.0, 1.3, 1.6, 1.8, 3.0}) {
      SketchOptions options;
      options.smooth = false;
      const auto sketch = test::sketch_on(mesh, reference(), options);
      const double length = 0.8 * longer, turn = pi * 170 / 180 / (0.3 * length);
      const Stroke target =
          test::curved(front_pixel(0.0, 0.1), length, [&](double s) { return s > 0.35 && s < 0.65 ? turn : 0.0; });
      REQUIRE(sketch->bend(target).ok());
      REQUIRE(sketch->refine(mesh.triangles, 2000).ok());
      if (longer == 3.0) CHECK(sketch->refinement()->parents.size() > 100);
    }
  }
}

TEST_CASE("nothing is refined where nothing stretches, and limits are kept") {
  const test::Mesh mesh = seamed_tube();
  const auto sketch = test::sketch_on(mesh, reference());
  REQUIRE(sketch->refine(mesh.triangles).ok());
  CHECK(sketch->refinement()->parents.empty());
  REQUIRE(sketch->bend(long_hook()).ok());
  const Status status = sketch->refine(mesh.triangles, 10);
  CHECK(status.code() == ErrorCode::too_large);
  CHECK(sketch->refinement() == nullptr);
  CHECK(sketch->positions().cols() == mesh.vertices());
  const std::vector<std::uint32_t> wrong{0, 1, 100000};
  CHECK(sketch->refine(wrong).message().find("triangles[2] is 100000") == 0);
}

TEST_CASE("restore brings back what was saved, bit for bit, or changes nothing") {
  const test::Mesh mesh = seamed_tube();
  const auto sketch = test::sketch_on(mesh, reference());
  REQUIRE(sketch->bend(long_hook()).ok());
  REQUIRE(sketch->twist(1.0).ok());
  REQUIRE(sketch->set_morph(0.7).ok());
  Deformation& deformation = *sketch;
  const State saved = deformation.save();
  const Points posed = deformation.positions();

  REQUIRE(sketch->set_morph(1.0).ok());
  REQUIRE(sketch->bend(reference()).ok());
  REQUIRE(deformation.positions() != posed);
  REQUIRE(deformation.restore(saved).ok());
  CHECK(deformation.positions() == posed);
  CHECK(sketch->pose().twists());

  // A refined state comes back while its vertices are there; an older one takes them away.
  REQUIRE(sketch->refine(mesh.triangles).ok());
  const State refined = deformation.save();
  const Points all = deformation.positions();
  REQUIRE(all.cols() > posed.cols());
  deformation.reset();
  REQUIRE(deformation.restore(refined).ok());
  CHECK(deformation.positions() == all);
  REQUIRE(deformation.restore(saved).ok());
  CHECK(deformation.positions() == posed);

  // Bad states.
  CHECK(deformation.restore(refined).code() == ErrorCode::invalid_option);
  for (const char* name : {"labels", "reference", "morph", "s", "pose/heading", "pose/turns", "pose/twist"}) {
    CAPTURE(name);
    State broken = saved;
    for (StateTable& table : broken.tables) {
      if (table.name == name) table.data.assign(2, 5.0);
    }
    CHECK(deformation.restore(broken).code() == ErrorCode::invalid_option);
    CHECK(deformation.positions() == posed);
  }
  const auto other = test::sketch_on(mesh, test::straight(front_pixel(0.0, 0.2), front_pixel(0.0, 0.8)));
  CHECK(other->restore(saved).code() == ErrorCode::invalid_option);
  CHECK(deformation.transform_points(posed).status().code() == ErrorCode::not_solvable);
}

}  // namespace
}  // namespace pliant
