// What is rigid-cells' own; the laws of every method are in laws_test.cpp.
#include "pliant/deformers/rigid_cells/deformer.h"

#include <algorithm>
#include <numbers>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/geometry/closest_rotation.h"
#include "pliant/geometry/measure.h"
#include "support/edits.h"
#include "support/random.h"
#include "support/shapes.h"

using namespace pliant;
using test::distance;

namespace {

std::unique_ptr<RigidCells> cells_over(const test::Mesh& mesh, const RigidCellsOptions& options = {}) {
  auto deformer = RigidCells::create(test::shape_of(mesh), options);
  REQUIRE(deformer.ok());
  return std::move(*deformer);
}

/// A bar along z, 4 x 1 x 1, its lowest part fixed, its highest one handle 1.
struct Bar {
  test::Mesh mesh =
      test::transformed(test::box(1.0, 1.0, 4.0, 0.125), 1.0, Eigen::Matrix3d::Identity(), {-0.5, -0.5, 0});
  std::unique_ptr<RigidCells> deformer;

  explicit Bar(const RigidCellsOptions& options = {}) : deformer(cells_over(mesh, options)) {
    REQUIRE(deformer->set_fixed(test::pick(mesh, [](const auto& p) { return p.z() < 0.3; })).ok());
    REQUIRE(deformer->add_handle(test::pick(mesh, [](const auto& p) { return p.z() > 3.7; })).ok());
  }
  void turn(double degrees, const Eigen::Vector3d& axis = {0, 0, 1}, const Eigen::Vector3d& translation = {0, 0, 0}) {
    REQUIRE(deformer->move_handle(1, test::turn(degrees, axis, {0, 0, 3.85}, translation)).ok());
    test::settle(*deformer, 300, 1e-8);
  }
  Quality quality() const { return measure_quality(deformer->shape(), deformer->point_positions(), false); }
  /// Turn about z of the points around a height, degrees.
  double turned_at(double z) const {
    const Points now = deformer->positions();
    double sum = 0.0;
    int count = 0;
    for (Index v = 0; v < mesh.vertices(); ++v) {
      const Eigen::Vector3d rest = mesh.vertex(v);
      if (std::abs(rest.z() - z) > 0.01 || rest.head<2>().norm() < 0.6) continue;
      sum += std::remainder(std::atan2(now(1, v), now(0, v)) - std::atan2(rest.y(), rest.x()), 2.0 * std::numbers::pi);
      ++count;
    }
    REQUIRE(count > 0);
    return sum / count * 180.0 / std::numbers::pi;
  }
};

}  // namespace

TEST_CASE("a twisted and a bent bar keep their volume; a shell keeps less of it") {
  for (const bool twist : {true, false}) {
    CAPTURE(twist);
    Bar solid, shell({.interior = false});
    for (Bar* bar : {&solid, &shell}) {
      if (twist) {
        bar->turn(120.0);
      } else {
        bar->turn(70.0, {1, 0, 0}, {0, -0.3, -0.5});
      }
    }
    const double of_solid = std::abs(*solid.quality().volume - 1.0), of_shell = std::abs(*shell.quality().volume - 1.0);
    CHECK(of_solid < 0.07);
    CHECK(of_shell > of_solid);
    CHECK(solid.quality().folds == 0);
  }
}

TEST_CASE("turns beyond half a turn are honoured, and spread along the bar") {
  Bar bar;
  bar.turn(300.0);
  CHECK(bar.turned_at(2.0) == doctest::Approx(150.0).epsilon(0.03));
  // The same by degrees ends in the same place.
  Bar slow;
  for (double degrees = 60.0; degrees <= 300.0; degrees += 60.0) slow.turn(degrees);
  CHECK(distance(slow.deformer->positions(), bar.deformer->positions()) < 1e-3 * bar.deformer->shape().diagonal());
}

TEST_CASE("a softened half gives way more than twice as much as the other") {
  const auto soft = [](const auto& p) { return p.z() < 2.0; };
  Bar plain;
  const Bar bar = [&] {
    Bar result({.stiffness = {{test::pick(plain.mesh, soft), 0.1}}});
    result.turn(60.0);
    return result;
  }();
  const double lower = bar.turned_at(2.0), upper = 60.0 - lower;
  CHECK(lower > 2.0 * upper);
}

TEST_CASE("cells held whole keep their turn; held at a point, as of a lone vertex, they lean") {
  // The top of the bar pulled aside.
  const test::Mesh mesh = Bar().mesh;
  const std::vector<Index> top = test::pick(mesh, [](const auto& p) { return p.z() > 3.99; });
  const std::vector<Index> corner =
      test::pick(mesh, [](const auto& p) { return (p - Eigen::Vector3d(0.5, 0.5, 4)).norm() < 0.01; });
  const auto largest_turn = [&](const std::vector<Index>& grabbed, CellHold hold) {
    const auto deformer = cells_over(mesh, {.hold = hold});
    REQUIRE(deformer->set_fixed(test::pick(mesh, [](const auto& p) { return p.z() < 0.3; })).ok());
    const auto handle = deformer->add_handle(grabbed);
    REQUIRE(handle.ok());
    REQUIRE(deformer->move_handle(*handle, test::turn(0, {0, 0, 1}, {0, 0, 0}, {1.5, 0, -0.3})).ok());
    test::settle(*deformer, 300, 1e-8);
    const State state = deformer->save();
    const auto& held = state.find("cells[]/held")->data;
    double largest = 0.0;
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (held[i] == 0.0 || state.find("cells[]/center")->data[3 * i + 2] < 3.5) continue;
      const double* r = &state.find("cells[]/rotation")->data[9 * i];
      const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r);
      largest = std::max(largest, rotation_vector_of(rotation).norm());
    }
    return largest;
  };
  CHECK(largest_turn(top, CellHold::cells) < 1e-9);
  CHECK(largest_turn(top, CellHold::points) > 0.01);
  CHECK(largest_turn({corner[0]}, CellHold::cells) > 0.3);
}

TEST_CASE("a point that is held stays where it is held while its cell turns") {
  const test::Mesh mesh = Bar().mesh;
  const auto deformer = cells_over(mesh, {.hold = CellHold::points});
  REQUIRE(deformer->set_fixed(test::pick(mesh, [](const auto& p) { return p.z() < 0.3; })).ok());
  const auto handle =
      deformer->add_handle(std::vector<Index>{test::pick(mesh, [](const auto& p) { return p.z() > 3.99; })[0]});
  REQUIRE(handle.ok());
  REQUIRE(deformer->move_handle(*handle, test::turn(0, {0, 0, 1}, {0, 0, 0}, {2.0, 0.5, -1.0})).ok());
  test::settle(*deformer, 300, 1e-8);
  const State state = deformer->save();
  const auto& held = state.find("cells[]/held")->data;
  const Eigen::Vector3d target = deformer->handles()[0].targets.col(0);
  int at_points = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] != 2.0) continue;
    ++at_points;
    const Eigen::Matrix3d rotation =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&state.find("cells[]/rotation")->data[9 * i]);
    const Eigen::Vector3d point(&state.find("cells[]/point")->data[3 * i]);
    const Eigen::Vector3d now = rotation * point + Eigen::Vector3d(&state.find("cells[]/translation")->data[3 * i]);
    CHECK((now - (point.z() > 3.5 ? target : point)).norm() < 1e-12);
  }
  CHECK(at_points > 10);
}

TEST_CASE("targets that follow an affine motion turn their cells by its rigid part") {
  Bar bar;
  const std::vector<Index> moved = test::pick(bar.mesh, [](const auto& p) { return p.z() > 3.7; });
  const Eigen::Matrix3d turn = rotation_of({0, 0, 0.8});
  Points targets(3, static_cast<Index>(moved.size()));
  for (std::size_t i = 0; i < moved.size(); ++i) {
    targets.col(static_cast<Index>(i)) = turn * Eigen::Vector3d(1.1, 1.1, 1.1).asDiagonal() * bar.mesh.vertex(moved[i]);
  }
  REQUIRE(bar.deformer->set_targets(1, targets).ok());
  test::settle(*bar.deformer, 300, 1e-8);
  CHECK(bar.turned_at(4.0) == doctest::Approx(0.8 * 180.0 / std::numbers::pi).epsilon(0.02));
}

TEST_CASE("refinement adds cells where the strain is, which inherit their parents' motions") {
  Bar bar({.resolution = 8, .boundary_levels = 0, .refine = true});
  bar.turn(100.0, {1, 0, 0}, {0, -0.3, -0.8});
  const Points before = bar.deformer->positions();
  const auto added = bar.deformer->refine();
  REQUIRE(added.ok());
  CHECK(*added > 0);
  CHECK(distance(bar.deformer->positions(), before) < 0.05 * bar.deformer->shape().diagonal());
  test::settle(*bar.deformer, 300, 1e-8);
  // A saved state brings the finer cells along, and back to the coarse ones.
  const State fine = bar.deformer->save();
  Bar other({.resolution = 8, .boundary_levels = 0, .refine = true});
  const State coarse = other.deformer->save();
  REQUIRE(other.deformer->restore(fine).ok());
  CHECK(distance(other.deformer->positions(), bar.deformer->positions()) < 1e-9);
  REQUIRE(other.deformer->restore(coarse).ok());
  CHECK(other.deformer->save().find("cells[]/size")->data == coarse.find("cells[]/size")->data);
  // While nothing moves cells do not come and go; back near rest those that were split are joined again.
  for (int round = 0; *bar.deformer->refine() > 0; ++round) {
    REQUIRE(round < 5);
    test::settle(*bar.deformer, 300, 1e-8);
  }
  const auto cells = [&] { return bar.deformer->save().find("cells[]/size")->data.size(); };
  const std::size_t finest = cells();
  for (const double degrees : {20.0, 1.0, 0.5, 0.25}) {
    bar.turn(degrees, {1, 0, 0});
    const Points settled = bar.deformer->positions();
    (void)*bar.deformer->refine();
    CHECK(distance(bar.deformer->positions(), settled) < 0.01 * bar.deformer->shape().diagonal());
  }
  CHECK(cells() < finest);
  CHECK(cells() == coarse.find("cells[]/size")->data.size());
  // Without the option nothing is refined.
  Bar plain;
  plain.turn(100.0, {1, 0, 0});
  CHECK(*plain.deformer->refine() == 0);
}

TEST_CASE("small pieces of a soup stay rigid while the shape bends") {
  // Leaves of two triangles around a trunk.
  test::Mesh mesh = test::box(1.0, 1.0, 4.0, 0.25);
  test::Random random(17);
  for (int leaf = 0; leaf < 300; ++leaf) {
    const Eigen::Vector3d at(3.0 * random.number() + 0.5, 3.0 * random.number() + 0.5, 4.0 + random.number());
    const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d p = at + 0.1 * random.vector(3);
      mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 1u, 3u, 2u}) mesh.triangles.push_back(first + corner);
  }
  const auto deformer = cells_over(mesh);
  REQUIRE(deformer->set_fixed(test::pick(mesh, [](const auto& p) { return p.z() < 0.3; })).ok());
  const auto handle = deformer->add_handle(test::pick(mesh, [](const auto& p) { return p.z() > 4.9; }));
  REQUIRE(handle.ok());
  REQUIRE(deformer->move_handle(*handle, test::turn(80, {1, 0, 0}, {0.5, 0.5, 5}, {0, -2, -2})).ok());
  test::settle(*deformer, 100, 1e-6);
  const Points now = deformer->positions();
  double worst = 0.0;
  for (std::size_t t = mesh.triangles.size() - 1800; t < mesh.triangles.size(); t += 3) {
    for (int k = 0; k < 3; ++k) {
      const Index a = static_cast<Index>(mesh.triangles[t + k]),
                  b = static_cast<Index>(mesh.triangles[t + (k + 1) % 3]);
      const double before = (mesh.vertex(a) - mesh.vertex(b)).norm(), after = (now.col(a) - now.col(b)).norm();
      worst = std::max(worst, std::abs(after / before - 1.0));
    }
  }
  CHECK(worst < 0.02);
}

TEST_CASE("shapes of every kind are accepted: points, a flat sheet, the plane, one point, nothing held") {
  test::Mesh points = test::potato(3);
  points.triangles.clear();
  for (const auto& mesh : {points, test::plane_grid(12, 12), test::Mesh{{0, 0, 0, 0, 0, 0}, {}}}) {
    const auto deformer = cells_over(mesh);
    const auto handle = deformer->add_handle(std::vector<Index>{0});
    REQUIRE(handle.ok());
    REQUIRE(deformer->move_handle(*handle, test::turn(0, {0, 0, 1}, {0, 0, 0}, {0.5, 0, 0})).ok());
    test::settle(*deformer);
    Points expected = deformer->shape().scatter(deformer->shape().points());
    expected.row(0).array() += 0.5;
    CHECK(distance(deformer->positions(), expected) < 1e-6);
  }
  std::vector<double> flat;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 20; ++x) flat.insert(flat.end(), {0.1 * x, 0.1 * y});
  }
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 19; ++x) {
      const std::uint32_t a = y * 20 + x;
      triangles.insert(triangles.end(), {a, a + 1, a + 20, a + 1, a + 21, a + 20});
    }
  }
  const auto shape = *Shape::create(flat, triangles, 2);
  auto deformer = std::move(*RigidCells::create(shape, {}));
  std::vector<Index> left, right;
  for (Index v = 0; v < 100; ++v) {
    if (v % 20 < 2) left.push_back(v);
    if (v % 20 > 17) right.push_back(v);
  }
  REQUIRE(deformer->set_fixed(left).ok());
  const auto handle = deformer->add_handle(right);
  REQUIRE(deformer->move_handle(*handle, test::turn(70, {0, 0, 1}, {1.9, 0.2, 0}, {-0.4, 0.6, 0})).ok());
  test::settle(*deformer);
  const Quality quality = measure_quality(*shape, deformer->point_positions(), false);
  CHECK(*quality.area == doctest::Approx(1.0).epsilon(0.06));
  CHECK(deformer->point_positions().row(2).isZero(0.0));
}

TEST_CASE("bad options are named") {
  const auto shape = test::shape_of(test::potato(2));
  const auto message = [&](const RigidCellsOptions& options) {
    const auto result = RigidCells::create(shape, options);
    CHECK(result.status().code() == ErrorCode::invalid_option);
    return result.status().message();
  };
  CHECK(message({.resolution = 0}).find("resolution is 0") != std::string::npos);
  CHECK(message({.boundary_levels = 9}).find("boundaryLevels is 9") != std::string::npos);
  CHECK(message({.stiffness = {{{1}, -2.0}}}).find("stiffness[0].factor") != std::string::npos);
  CHECK(message({.stiffness = {{{}, 2.0}}}).find("stiffness[0]") != std::string::npos);
  CHECK(message({.stiffness = {{{100000}, 2.0}}}).find("vertex 100000") != std::string::npos);
}

TEST_CASE("points that are held end at their targets, of any motion, whatever carries the others") {
  for (const CellTransfer transfer : {CellTransfer::rbf, CellTransfer::blend}) {
    CAPTURE(static_cast<int>(transfer));
    Bar bar({.transfer = transfer});
    const std::vector<Index> moved = test::pick(bar.mesh, [](const auto& p) { return p.z() > 3.7; });
    Motion motion = test::turn(70, {1, 0, 0}, {0, 0, 3.85}, {0, -0.6, -0.6});
    motion.scale = 1.3;
    motion.center = {0, 0, 3.85};
    REQUIRE(bar.deformer->move_handle(1, motion).ok());
    const auto lone = bar.deformer->add_handle(
        test::pick(bar.mesh, [](const auto& p) { return (p - Eigen::Vector3d(0.5, 0.5, 2.0)).norm() < 0.01; }));
    REQUIRE(lone.ok());
    REQUIRE(bar.deformer->move_handle(*lone, test::turn(0, {0, 0, 1}, {0, 0, 0}, {0.4, 0, 0})).ok());
    test::settle(*bar.deformer, 300, 1e-8);
    const Points now = bar.deformer->positions();
    double most = 0.0;
    for (const Index v : moved) most = std::max(most, (now.col(v) - motion.apply(bar.mesh.vertex(v))).norm());
    for (const Index p : bar.deformer->fixed_points()) {
      most = std::max(most, (bar.deformer->point_positions().col(p) - bar.deformer->shape().points().col(p)).norm());
    }
    CHECK(most < 1e-12 * bar.deformer->shape().diagonal());
    CHECK((bar.deformer->point_positions().col(bar.deformer->handles()[1].points[0]) -
           bar.deformer->handles()[1].targets.col(0))
              .norm() < 1e-12 * bar.deformer->shape().diagonal());
    // Other points at the same places go there, too.
    Points places(3, static_cast<Index>(moved.size()));
    for (Index i = 0; i < places.cols(); ++i) places.col(i) = bar.mesh.vertex(moved[i]);
    CHECK(distance(*bar.deformer->transform_points(places), now(Eigen::all, moved)) < 1e-12);
  }
}
