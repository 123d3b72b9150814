// What material-aware edges do beyond the laws: the figures of the paper.
#include "pliant/deformers/edge_material/deformer.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "deformers/edge_material/reference.h"
#include "pliant/geometry/measure.h"
#include "support/edits.h"

using namespace pliant;
using Kind = DirectionField::Kind;

namespace {

std::unique_ptr<EdgeMaterial> material_of(const test::Mesh& mesh, const EdgeMaterialOptions& options = {}) {
  auto deformer = EdgeMaterial::create(test::shape_of(mesh), options);
  REQUIRE_MESSAGE(deformer.ok(), deformer.status().message());
  return std::move(*deformer);
}

double mean_stretch(const Deformer& deformer) {
  return measure_quality(deformer.shape(), deformer.point_positions(), false).stretch_mean;
}

Motion shift(const Eigen::Vector3d& by) {
  Motion motion;
  motion.translation = by;
  return motion;
}

/// A square of n x n vertices, corners fixed, the centre a handle.
std::unique_ptr<EdgeMaterial> cornered_plane(int n, const EdgeMaterialOptions& options) {
  auto deformer = material_of(test::plane_grid(n, n), options);
  REQUIRE(deformer->set_fixed(std::vector<Index>{0, n - 1, n * (n - 1), n * n - 1}).ok());
  REQUIRE(deformer->add_handle(std::vector<Index>{n / 2 * n + n / 2}).ok());
  return deformer;
}

std::unique_ptr<EdgeMaterial> lifted_plane(int n, const EdgeMaterialOptions& options) {
  auto deformer = cornered_plane(n, options);
  REQUIRE(deformer->move_handle(1, shift({0, 0, 0.3})).ok());
  CHECK(test::settle(*deformer, 200, 1e-8).converged);
  return deformer;
}

constexpr int kRings = 47, kAround = 30;
constexpr double kLength = 9.6;

/// A tube whose diagonals alternate: with all of them one way it would be chiral.
test::Mesh even_tube() {
  test::Mesh mesh = test::tube(kAround, kRings, 1.0, kLength);
  for (int j = 0; j + 1 < kRings; ++j) {
    for (int i = 0; i < kAround; ++i) {
      if ((i + j) % 2 == 0) continue;
      std::uint32_t* t = &mesh.triangles[6 * (j * kAround + i)];  // a b c, a c d
      const std::uint32_t a = t[0], b = t[1], c = t[2], d = t[5];
      const std::uint32_t flipped[6] = {a, b, d, b, c, d};
      std::copy(flipped, flipped + 6, t);
    }
  }
  return mesh;
}

/// One end ring fixed, the other a handle that turns.
std::unique_ptr<EdgeMaterial> grabbed_tube(double lambda) {
  auto deformer = material_of(even_tube(), {.lambda = lambda});
  std::vector<Index> first, last;
  for (Index i = 0; i < kAround; ++i) {
    first.push_back(i);
    last.push_back(kAround * (kRings - 1) + i);
  }
  REQUIRE(deformer->set_fixed(first).ok());
  REQUIRE(deformer->add_handle(last).ok());
  return deformer;
}

double middle_radius(const Deformer& tube) {
  return tube.positions().middleCols(kRings / 2 * kAround, kAround).topRows<2>().colwise().norm().mean();
}

double degrees_turned(const Deformer& tube) {
  const Points now = tube.positions();
  double turned = 0.0;  // added up ring by ring
  for (int j = 1; j < kRings; ++j) {
    const Eigen::Vector3d a = now.col(kAround * (j - 1)), b = now.col(kAround * j);
    turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
  }
  return turned * 180.0 / std::numbers::pi;
}

}  // namespace

TEST_CASE("edge material: unedited shapes of every kind stay put") {
  test::Mesh fins = test::plane_grid(6, 6);
  fins.positions.insert(fins.positions.end(), {0.5, 0.5, 0.3});
  fins.triangles.insert(fins.triangles.end(), {14, 15, 36});
  for (const auto& mesh :
       {test::plane_grid(12, 12), test::bumpy_plane(25, 2, 0.05), test::tube(20, 12), even_tube(), test::torus(30, 14),
        test::sphere(2), test::soup(test::potato(2)), fins, test::box(1, 0.6, 0.4, 0.2)}) {
    for (double stretch : {0.0, 1.0}) {
      const auto deformer = material_of(mesh, {.stretch = stretch});
      REQUIRE(deformer->add_handle(std::vector<Index>{0, 3, 11}).ok());
      for (int i = 0; i < 15; ++i) REQUIRE(deformer->step(1e-12).ok());
      CHECK(mean_stretch(*deformer) < 1e-6);
      // Let go after an edit they come back: rest is where the iteration rests, too.
      REQUIRE(deformer->move_handle(1, shift({0, 0, 1e-3})).ok());
      test::settle(*deformer, 100, 1e-10);
      CHECK(mean_stretch(*deformer) < 1e-6);
    }
  }
}

TEST_CASE("edge material rests at or below the energy of the paper's own iteration") {
  const auto mesh = test::potato(2);
  for (const auto& options : {EdgeMaterialOptions{.lambda = 0.01}, EdgeMaterialOptions{.lambda = 0.5},
                              EdgeMaterialOptions{.lambda = 0.1, .p_stretch = 0.5, .p_bend = 0.8},
                              EdgeMaterialOptions{.lambda = 0.1, .field = {.kind = Kind::axis, .axis = {1, 0, 0}}}}) {
    const auto deformer = material_of(mesh, options);
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    REQUIRE(deformer->move_handle(handle, test::turn(40, {1, 0.3, 0}, {0, 0, 0.6}, {0, 0, 0.2})).ok());
    CHECK(test::settle(*deformer, 300, 1e-10).converged);
    const test::EdgeReference reference(deformer->save());
    Points x = deformer->positions();
    CHECK(reference.energy(x) == doctest::Approx(deformer->energy().total).epsilon(1e-9));

    // The state speaks of vertices, the deformer of points in an order of its own.
    const Shape& shape = deformer->shape();
    const Handle& moved = deformer->handles()[0];
    std::vector<bool> held(x.cols(), false);
    Points cold = shape.scatter(shape.points());
    for (Index p : deformer->fixed_points()) held[shape.vertex_of_point()[p]] = true;
    for (std::size_t i = 0; i < moved.points.size(); ++i) {
      const Index vertex = shape.vertex_of_point()[moved.points[i]];
      held[vertex] = true;
      cold.col(vertex) = moved.targets.col(static_cast<Index>(i));
    }
    reference.iterate(cold, held, 300);
    // The paper leaves out that normals turn with the points, which shifts its rest a little.
    CHECK(deformer->energy().total <= reference.energy(cold) * (1.0 + 1e-9));
    CHECK(deformer->energy().total >= reference.energy(cold) * 0.97);
    CHECK(test::distance(x, cold) < 0.02 * deformer->shape().diagonal());
  }
}

TEST_CASE("edge material: one full step from the start is the paper's first iteration") {
  const auto mesh = test::bumpy_plane(9, 1, 0.1);
  const auto deformer = material_of(mesh, {.lambda = 0.1, .p_stretch = 0.7});
  REQUIRE(deformer->set_fixed(std::vector<Index>{0, 8, 72, 80}).ok());
  REQUIRE(deformer->add_handle(std::vector<Index>{40}).ok());
  const Points rest = deformer->positions();
  REQUIRE(deformer->move_handle(1, shift({0, 0, 0.05})).ok());
  REQUIRE(deformer->step().ok());
  std::vector<bool> held(81, false);
  for (Index p : {0, 8, 72, 80, 40}) held[p] = true;
  Points x = rest;
  x(2, 40) += 0.05;
  test::EdgeReference(deformer->save()).iterate(x, held, 1);
  // Up to the turn of normals, second order in the move.
  CHECK(test::distance(deformer->positions(), x) < 0.1 * test::distance(x, rest));
}

TEST_CASE("edge material, figure 2: the stiffer against stretch the less a lifted plane stretches") {
  const double soft = mean_stretch(*lifted_plane(101, {.lambda = 0.0}));
  CHECK(mean_stretch(*lifted_plane(101, {.lambda = 1e-4})) <= 0.95 * soft);
  CHECK(mean_stretch(*lifted_plane(101, {.lambda = 1e-3})) <= 0.75 * soft);
}

TEST_CASE("edge material: the same stretch on finer planes stretches them the same") {
  const double coarse = mean_stretch(*lifted_plane(51, {.stretch = 2.0}));
  for (int n : {101, 201}) {
    const auto fine = lifted_plane(n, {.stretch = 2.0});
    CHECK(mean_stretch(*fine) == doctest::Approx(coarse).epsilon(0.01));
  }
}

TEST_CASE("edge material: (lambda, p) and (lambda p, 1) rest in the same state") {
  const auto whole = lifted_plane(31, {.lambda = 0.002 * 0.3});
  const auto part = lifted_plane(31, {.lambda = 0.002, .p_stretch = 0.3});
  CHECK(test::distance(whole->positions(), part->positions()) < 1e-5);
  CHECK(whole->energy().total == doctest::Approx(part->energy().total));
}

TEST_CASE("edge material, figure 3: a tube twisted by 90 degrees settles, keeps its width, and mirrors") {
  Points twisted[2];
  for (double sign : {1.0, -1.0}) {
    const auto tube = grabbed_tube(0.0);
    REQUIRE(tube->move_handle(1, test::turn(sign * 90, {0, 0, 1}, {0, 0, 0})).ok());
    Points before = tube->positions();
    for (int i = 1; i <= 30; ++i) {
      REQUIRE(tube->step(1e-12).ok());
      const Points now = tube->positions();
      if (i >= 10) CHECK(test::distance(now, before) < 0.004 * kLength);
      before = now;
    }
    CHECK(middle_radius(*tube) >= 0.93);
    CHECK(degrees_turned(*tube) == doctest::Approx(sign * 90).epsilon(1e-6));
    twisted[sign < 0] = before;
  }
  // The mirror image, y -> -y, of the tube is the tube: vertex i of a ring goes to -i.
  for (int j = 0; j < kRings; ++j) {
    for (int i = 0; i < kAround; ++i) {
      const Eigen::Vector3d p = twisted[0].col(j * kAround + i);
      const Eigen::Vector3d q = twisted[1].col(j * kAround + (kAround - i) % kAround);
      CHECK((Eigen::Vector3d(p.x(), -p.y(), p.z()) - q).norm() < 0.01);
    }
  }
}

TEST_CASE("edge material: the middle of a tube twisted by 180 degrees widens with lambda") {
  double last = 0.0;
  for (double lambda : {0.0, 1e-3, 1e-2}) {
    const auto tube = grabbed_tube(lambda);
    REQUIRE(tube->move_handle(1, test::turn(180, {0, 0, 1}, {0, 0, 0})).ok());
    CHECK(test::settle(*tube, 200, 1e-7).converged);
    CHECK(middle_radius(*tube) > last);
    last = middle_radius(*tube);
  }
}

TEST_CASE("edge material: 270 degrees turn 270 degrees, in one go or on from 150") {
  for (bool in_one_go : {true, false}) {
    const auto tube = grabbed_tube(1e-3);
    if (!in_one_go) {
      REQUIRE(tube->move_handle(1, test::turn(150, {0, 0, 1}, {0, 0, 0})).ok());
      test::settle(*tube, 50, 1e-7);
    }
    REQUIRE(tube->move_handle(1, test::turn(270, {0, 0, 1}, {0, 0, 0})).ok());
    test::settle(*tube, 200, 1e-7);
    CHECK(degrees_turned(*tube) == doctest::Approx(270).epsilon(1e-6));
  }
}

TEST_CASE("edge material: a plane pulled both ways gives way across its field") {
  const int n = 21;
  const auto mesh = test::plane_grid(n, n);
  for (bool with_field : {false, true}) {
    EdgeMaterialOptions options{.lambda = 0.1};
    if (with_field) options.field = {.kind = Kind::axis, .axis = {1, 0, 0}};
    const auto deformer = material_of(mesh, options);
    const std::pair<Index, Eigen::Vector3d> pulls[] = {{n / 2 * n, {-0.1, 0, 0}},
                                                       {n / 2 * n + n - 1, {0.1, 0, 0}},
                                                       {n / 2, {0, -0.1, 0}},
                                                       {(n - 1) * n + n / 2, {0, 0.1, 0}}};
    for (const auto& [vertex, by] : pulls) {
      const auto handle = deformer->add_handle(std::vector<Index>{vertex});
      REQUIRE(handle.ok());
      REQUIRE(deformer->move_handle(*handle, shift(by)).ok());
    }
    CHECK(test::settle(*deformer, 500, 1e-9).converged);
    const Points now = deformer->positions();
    double along_x = 0.0, along_y = 0.0;
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        along_x += (now.col(j * n + i + 1) - now.col(j * n + i)).norm() * (n - 1) - 1.0;
        along_y += (now.col((j + 1) * n + i) - now.col(j * n + i)).norm() * (n - 1) - 1.0;
      }
    }
    if (with_field) {
      CHECK(along_x <= 0.6 * along_y);
    } else {
      CHECK(along_x == doctest::Approx(along_y).epsilon(1e-6));
    }
  }
}

TEST_CASE("edge material: a field that vanishes gives finite results") {
  const auto deformer = material_of(test::plane_grid(9, 9), {.field = {.kind = Kind::axis, .axis = {0, 0, 1}}});
  REQUIRE(deformer->add_handle(std::vector<Index>{0, 1, 9}).ok());
  REQUIRE(deformer->move_handle(1, test::turn(30, {1, 0, 0}, {0, 0, 0}, {0, 0, 0.2})).ok());
  test::settle(*deformer);
  CHECK(deformer->positions().allFinite());
  CHECK(deformer->field()->isZero(0.0));
}

TEST_CASE("edge material, figure 5: a cloth pinned at its centre falls along gravity and settles") {
  for (double gravity : {0.0, 1.0}) {
    const auto cloth = material_of(test::plane_grid(61, 61), {.lambda = 1e-3, .gravity = {0, -gravity, -gravity}});
    REQUIRE(cloth->set_fixed(std::vector<Index>{30 * 61 + 30}).ok());
    CHECK(test::settle(*cloth, 300, 1e-6).converged);
    const Eigen::Vector3d fallen = cloth->positions().rowwise().mean() - Eigen::Vector3d(0.5, 0.5, 0);
    if (gravity == 0.0) {
      CHECK(cloth->point_positions() == cloth->shape().points());
    } else {
      CHECK(fallen.y() < -0.02);
      CHECK(fallen.z() < -0.02);
      CHECK(std::abs(fallen.x()) < 1e-3);
      CHECK(mean_stretch(*cloth) <= 0.08);
    }
  }
}

TEST_CASE("edge material: parts that nothing holds do not fall") {
  const auto mesh = test::both(test::plane_grid(5, 5),
                               test::transformed(test::plane_grid(5, 5), 1.0, Eigen::Matrix3d::Identity(), {3, 0, 0}));
  const auto deformer = material_of(mesh, {.gravity = {0, 0, -1}});
  REQUIRE(deformer->set_fixed(std::vector<Index>{0, 4}).ok());
  test::settle(*deformer, 300);
  const Points now = deformer->positions();
  CHECK(now.row(2).head(25).mean() < -0.05);
  CHECK(now.rightCols(25).row(2).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE(
    "edge material: p, gravity and targets are free while dragging, lambda costs one "
    "factorisation") {
  const auto deformer = lifted_plane(21, {.lambda = 1e-3});
  const auto cost_of = [&](EdgeMaterialOptions options) {
    const Counters before = deformer->counters();
    REQUIRE(deformer->set_options(options).ok());
    test::settle(*deformer, 300, 1e-10);
    const Counters after = deformer->counters();
    const auto fresh = cornered_plane(21, options);
    REQUIRE(fresh->set_targets(1, deformer->handles()[0].targets).ok());
    test::settle(*fresh, 300, 1e-10);
    CHECK(test::distance(fresh->positions(), deformer->positions()) < 1e-4);
    return std::pair(after.factorizations - before.factorizations, after.analyses - before.analyses);
  };
  const std::pair nothing(0, 0), one(1, 0);
  CHECK(cost_of({.lambda = 1e-3, .p_stretch = 0.5, .p_bend = 0.9}) == nothing);
  CHECK(cost_of({.lambda = 1e-3, .gravity = {0, 0, -0.5}}) == nothing);
  REQUIRE(deformer->move_handle(1, shift({0.05, 0, 0.25})).ok());
  CHECK(cost_of({.lambda = 1e-3, .gravity = {0, 0, -0.5}}) == nothing);
  CHECK(cost_of({.lambda = 5e-3}) == one);
  CHECK(cost_of({.lambda = 5e-3, .bend = 2.0}) == one);
  CHECK(cost_of({.stretch = 3.0}) == one);
  CHECK(cost_of({.stretch = 3.0, .field = {.kind = Kind::axis, .axis = {1, 1, 0}}}) == one);
  CHECK(cost_of({.stretch = 0.0}) == one);
}

TEST_CASE("edge material: stretch is lambda in units of the resolution") {
  const auto deformer = material_of(test::plane_grid(11, 11), {.stretch = 2.0});
  // 220 edges of 0.1 and 100 diagonals.
  const double h = (22.0 + 10.0 * std::sqrt(2.0)) / 320.0;
  CHECK(deformer->lambda() == doctest::Approx(2.0 * h * h / 2.0));
  CHECK(material_of(test::plane_grid(11, 11), {.lambda = 0.25})->lambda() == 0.25);
}

TEST_CASE("edge material: bad options are named, and change nothing") {
  using doctest::Contains;
  const auto deformer = material_of(test::plane_grid(5, 5));
  const auto refused = [&](const EdgeMaterialOptions& options, const char* name) {
    const Status status = deformer->set_options(options);
    CHECK(status.code() == ErrorCode::invalid_option);
    CHECK(status.message().c_str() == Contains(name));
    CHECK_FALSE(EdgeMaterial::create(test::shape_of(test::plane_grid(5, 5)), options).ok());
    CHECK(deformer->options().stretch == 1.0);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused({.stretch = -1.0}, "stretch");
  refused({.lambda = nan}, "lambda");
  refused({.bend = std::numeric_limits<double>::infinity()}, "bend");
  refused({.stretch = 0.0, .bend = 0.0}, "bend and stretch");
  refused({.p_stretch = 1.5}, "pStretch");
  refused({.p_bend = -0.1}, "pBend");
  refused({.gravity = {0, nan, 0}}, "gravity");
  refused({.field = {.kind = Kind::strokes}}, "strokes");
  refused({.field = {.kind = Kind::strokes, .strokes = {Points::Zero(3, 1)}}}, "strokes[0]");
  refused({.field = {.kind = Kind::strokes, .strokes = {Points::Zero(3, 4)}}}, "no length");
  refused({.field = {.kind = Kind::axis}}, "axis");
  refused({.field = {.kind = Kind::geodesic}}, "sources");
  refused({.field = {.kind = Kind::geodesic, .sources = {25}}}, "vertex 25");
}
