// The laws every deformer passes (CONTRIBUTING.md), over every registered method.
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/deformers/registry.h"
#include "support/edits.h"
#include "support/methods.h"

using namespace pliant;
using test::distance;

namespace {

/// The standard edit: bottom fixed, top turned by 60 degrees and moved aside, in a scene that was
/// itself scaled, turned and moved.
Points edited(const test::Method& method, const test::Mesh& mesh, const std::vector<Index>& fixed,
              const std::vector<Index>& moved, double scale = 1.0,
              const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity(),
              const Eigen::Vector3d& translation = Eigen::Vector3d::Zero()) {
  const auto deformer = method.make(test::shape_of(mesh));
  REQUIRE(deformer->set_fixed(fixed).ok());
  const auto handle = deformer->add_handle(moved);
  REQUIRE(handle.ok());
  Motion motion = test::turn(60, rotation * Eigen::Vector3d(0.3, 1.0, 0.2),
                             scale * (rotation * Eigen::Vector3d(0, 0, 1)) + translation);
  motion.translation = scale * (rotation * Eigen::Vector3d(0.4, -0.1, 0.2));
  REQUIRE(deformer->move_handle(*handle, motion).ok());
  test::settle(*deformer, 300, 1e-12);
  return deformer->positions();
}

struct Scene {
  test::Mesh mesh = test::potato(3);
  std::vector<Index> fixed = test::pick(mesh, [](const auto& p) { return p.z() < -0.6; });
  std::vector<Index> moved = test::pick(mesh, [](const auto& p) { return p.z() > 0.6; });
  double diagonal = test::shape_of(mesh)->diagonal();
};

}  // namespace

TEST_CASE("every registered method is under the laws") {
  const auto methods = test::methods();
  for (const RegisteredMethod& registered : registered_methods()) {
    CAPTURE(registered.name);
    CHECK(std::any_of(methods.begin(), methods.end(),
                      [&](const auto& method) { return method.name == registered.name; }));
  }
}

TEST_CASE("law 1: with targets at rest the shape stays at rest and the energy is zero") {
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    for (const auto& mesh : {test::potato(3), test::tube(24, 20), test::soup(test::torus(20, 10)),
                             test::both(test::potato(2), test::transformed(test::potato(2), 1.0,
                                                                           Eigen::Matrix3d::Identity(), {4, 0, 0}))}) {
      const auto shape = test::shape_of(mesh);
      const auto deformer = method.make(shape);
      const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
      REQUIRE(deformer->move_handle(handle, Motion{}).ok());
      const StepReport report = test::settle(*deformer);
      CHECK(report.converged);
      CHECK(deformer->energy().total == doctest::Approx(0.0));
      CHECK(distance(deformer->positions(), shape->scatter(shape->points())) < 1e-9 * shape->diagonal());
    }
  }
}

TEST_CASE("law 2: every point follows a rigid motion of the targets") {
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const Scene s;
    for (double degrees : {0.0, 10.0, 90.0, 170.0, 300.0}) {
      for (bool single : {false, true}) {
        CAPTURE(degrees);
        const auto deformer = method.make(test::shape_of(s.mesh));
        const Motion motion = test::turn(degrees, {1, 2, -1}, {3, 0, 1}, {0.5, -2, 1});
        // One region, or four single vertices that do not lie in a plane.
        const std::vector<Index> all = single ? std::vector<Index>{1, 100, 200, 300}
                                              : test::pick(s.mesh, [](const auto& p) { return p.x() > 0.3; });
        for (std::size_t i = 0; i < (single ? all.size() : 1); ++i) {
          const auto handle = deformer->add_handle(single ? std::vector<Index>{all[i]} : all);
          REQUIRE(handle.ok());
          REQUIRE(deformer->move_handle(*handle, motion).ok());
        }
        test::settle(*deformer);
        Points expected = deformer->shape().scatter(deformer->shape().points());
        for (auto column : expected.colwise()) column = motion.apply(column);
        CHECK(distance(deformer->positions(), expected) < 1e-6 * s.diagonal);
      }
    }
  }
}

TEST_CASE("law 3: an accepted step never raises the energy") {
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const auto mesh = test::tube(24, 30, 0.3, 2.0);
    for (double degrees : {20.0, 90.0, 150.0}) {
      for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0)}) {
        CAPTURE(degrees);
        const auto deformer = method.make(test::shape_of(mesh));
        const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
        for (double part : {0.5, 1.0}) {  // a second drag starts from the first one's result
          REQUIRE(deformer->move_handle(handle, test::turn(part * degrees, axis, {0, 0, 1}, {0.2, 0, 0.1})).ok());
          double energy = deformer->energy().total;
          for (int i = 0; i < 60; ++i) {
            const auto report = deformer->step(1e-9);
            REQUIRE(report.ok());
            CHECK(report->energy <= energy);
            CHECK(report->energy == doctest::Approx(deformer->energy().total));
            energy = report->energy;
            if (report->converged || !report->accepted) break;
          }
        }
      }
    }
  }
}

TEST_CASE("law 4: reset restores the rest positions bit for bit") {
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const auto mesh = test::transformed(test::potato(2), 3.7, Eigen::Matrix3d::Identity(), {1e3, -20, 0.1});
    const auto shape = test::shape_of(mesh);
    const auto deformer = method.make(shape);
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    const Points rest = shape->scatter(shape->points());
    REQUIRE(deformer->move_handle(handle, test::turn(40, {0, 1, 0}, {1e3, -20, 0}, {1, 0, 0})).ok());
    test::settle(*deformer);
    const Points bent = deformer->positions();
    CHECK(distance(bent, rest) > 0.01 * shape->diagonal());
    deformer->reset();
    CHECK(deformer->positions() == rest);
    CHECK(deformer->energy().total == 0.0);
    // The same edit after a reset gives the same result.
    REQUIRE(deformer->move_handle(handle, test::turn(40, {0, 1, 0}, {1e3, -20, 0}, {1, 0, 0})).ok());
    test::settle(*deformer);
    CHECK(deformer->positions() == bent);
  }
}

TEST_CASE("law 5: scaling, moving, turning the scene and renumbering its vertices change nothing else") {
  const Scene s;
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const Points reference = edited(method, s.mesh, s.fixed, s.moved);
    auto check = [&](double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation, double within) {
      Points moved = edited(method, test::transformed(s.mesh, scale, rotation, translation), s.fixed, s.moved, scale,
                            rotation, translation);
      moved = rotation.transpose() * (moved.colwise() - translation) / scale;
      CHECK(distance(moved, reference) < within * s.diagonal);
    };
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    SUBCASE("scale") {
      check(0.01, identity, {0, 0, 0}, 1e-5);
      check(100.0, identity, {0, 0, 0}, 1e-5);
    }
    SUBCASE("move") { check(1.0, identity, {1000, -300, 77}, 1e-5); }
    SUBCASE("quarter turns") {
      Eigen::Matrix3d quarter;
      quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      Eigen::Matrix3d cycle;
      cycle << 0, 1, 0, 0, 0, 1, 1, 0, 0;
      check(1.0, quarter, {0, 0, 0}, 1e-5);
      check(1.0, cycle * quarter * quarter, {0, 0, 0}, 1e-5);
    }
    SUBCASE("any turn") {
      check(1.0, Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {0, 0, 0},
            method.isotropy);
    }
    SUBCASE("renumber") {
      std::vector<Index> new_of_old;
      const test::Mesh other = test::renumbered(s.mesh, 5, &new_of_old);
      auto renumber = [&](std::vector<Index> ids) {
        for (Index& id : ids) id = new_of_old[id];
        return ids;
      };
      const Points moved = edited(method, other, renumber(s.fixed), renumber(s.moved));
      CHECK(distance(moved(Eigen::all, new_of_old), reference) < 1e-5 * s.diagonal);
    }
  }
}

TEST_CASE("law 6: a reused factorisation gives what a fresh one gives") {
  const Scene s;
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const auto dragged = method.make(test::shape_of(s.mesh));
    REQUIRE(dragged->set_fixed(s.fixed).ok());
    const auto handle = dragged->add_handle(s.moved);
    REQUIRE(handle.ok());
    for (double degrees : {5.0, 10.0, 15.0, 20.0}) {
      REQUIRE(dragged->move_handle(*handle, test::turn(degrees, {0, 1, 0}, {0, 0, 1})).ok());
      test::settle(*dragged, 300, 1e-12);
    }
    const auto fresh = method.make(test::shape_of(s.mesh));
    REQUIRE(fresh->set_fixed(s.fixed).ok());
    REQUIRE(fresh->add_handle(s.moved).ok());
    REQUIRE(fresh->move_handle(1, test::turn(20, {0, 1, 0}, {0, 0, 1})).ok());
    test::settle(*fresh, 300, 1e-12);
    CHECK(dragged->counters().analyses == 1);
    CHECK(distance(dragged->positions(), fresh->positions()) < 1e-5 * s.diagonal);
    CHECK(dragged->energy().total == doctest::Approx(fresh->energy().total).epsilon(1e-6));
  }
}

TEST_CASE("law 6: reset and restore under the same constraints factorise nothing, and lose nothing") {
  const Scene s;
  for (const auto& methods : {test::methods(), test::exact_methods()}) {
    for (const auto& method : methods) {
      CAPTURE(method.name);
      const auto deformer = method.make(test::shape_of(s.mesh));
      REQUIRE(deformer->set_fixed(s.fixed).ok());
      const auto handle = deformer->add_handle(s.moved);
      REQUIRE(handle.ok());
      const auto turned = [&](double degrees) {
        REQUIRE(deformer->move_handle(*handle, test::turn(degrees, {0, 1, 0}, {0, 0, 1})).ok());
        for (int i = 0; i < 2; ++i) REQUIRE(deformer->step().ok());
        return deformer->positions();
      };
      const Points first = turned(20);
      const State state = deformer->save();
      const Counters before = deformer->counters();
      turned(25);
      const int of_steps = deformer->counters().factorizations - before.factorizations;
      deformer->reset();
      CHECK(turned(20) == first);
      REQUIRE(deformer->restore(state).ok());
      CHECK(distance(deformer->positions(), first) < 1e-13 * s.diagonal);
      turned(25);
      CHECK(deformer->counters().factorizations == before.factorizations + 3 * of_steps);
      CHECK(deformer->counters().analyses == 1);
    }
  }
}

TEST_CASE("law 8: every platform computes the same, to 1e-9") {
  const Scene s;
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    REQUIRE(method.recorded);
    const auto deformer = method.make(test::shape_of(s.mesh));
    REQUIRE(deformer->set_fixed(s.fixed).ok());
    REQUIRE(deformer->add_handle(s.moved).ok());
    REQUIRE(deformer->move_handle(1, test::turn(35, {0.3, 1, 0.2}, {0, 0, 1}, {0.1, 0, 0.2})).ok());
    for (int i = 0; i < 6; ++i) REQUIRE(deformer->step(1e-12).ok());
    const Points p = deformer->positions();
    CHECK((p.rowwise().mean() - method.recorded->mean).norm() < 1e-9 * s.diagonal);
    CHECK((p.col(321) - method.recorded->vertex).norm() < 1e-9 * s.diagonal);
  }
}

TEST_CASE("a saved state restores the deformation, also into a fresh deformer") {
  const Scene s;
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const auto deformer = method.make(test::shape_of(s.mesh));
    const HandleId handle = test::fix_bottom_grab_top(*deformer, s.mesh);
    REQUIRE(deformer->move_handle(handle, test::turn(50, {1, 0, 0}, {0, 0, 0.5})).ok());
    test::settle(*deformer);
    const Points bent = deformer->positions();
    const State state = deformer->save();
    deformer->reset();
    REQUIRE(deformer->restore(state).ok());
    CHECK(distance(deformer->positions(), bent) < 1e-12 * s.diagonal);
    const auto other = method.make(test::shape_of(s.mesh));
    test::fix_bottom_grab_top(*other, s.mesh);
    REQUIRE(other->restore(state).ok());
    CHECK(distance(other->positions(), bent) < 1e-12 * s.diagonal);
    // Targets came along: solving on stays there.
    test::settle(*other);
    CHECK(distance(other->positions(), bent) < 1e-4 * s.diagonal);
    CHECK(deformer->restore(State{}).code() == ErrorCode::invalid_option);
    // Handles that are cut short: an error, and nothing has changed.
    State cut = state;
    for (StateTable& table : cut.tables) {
      if (table.name == "handles[]/targets[]") table.data.pop_back();
    }
    deformer->reset();
    CHECK(deformer->restore(cut).code() == ErrorCode::invalid_option);
    CHECK(deformer->positions() == deformer->shape().scatter(deformer->shape().points()));
  }
}

TEST_CASE("constraints are checked, and after an error the next correct call works") {
  for (const auto& method : test::methods()) {
    CAPTURE(method.name);
    const auto mesh = test::soup(test::potato(2));  // every point has copies
    const auto deformer = method.make(test::shape_of(mesh));
    using doctest::Contains;
    auto refused = [](const auto& result) {
      CHECK_FALSE(result.ok());
      return result;
    };
    const Index n = mesh.vertices();
    CHECK(refused(deformer->set_fixed(std::vector<Index>{0, n})).message().c_str() == Contains("fixed[1]"));
    CHECK(refused(deformer->set_fixed(std::vector<Index>{-1})).code() == ErrorCode::invalid_handle);
    CHECK(refused(deformer->set_fixed(std::vector<Index>{7, 7})).message().c_str() == Contains("listed before"));
    CHECK(refused(deformer->add_handle(std::vector<Index>{})).status().message().c_str() == Contains("empty"));
    REQUIRE(deformer->set_fixed(std::vector<Index>{0}).ok());
    CHECK(refused(deformer->add_handle(std::vector<Index>{0})).status().message().c_str() == Contains("fixed"));
    const auto handle = deformer->add_handle(std::vector<Index>{30, 31});
    REQUIRE(handle.ok());
    CHECK_FALSE(deformer->set_fixed(std::vector<Index>{31}).ok());
    CHECK(deformer->fixed_points().size() == 1);
    CHECK(refused(deformer->set_targets(*handle, Points::Zero(3, 1))).message().c_str() == Contains("expected 2"));
    Points poison = Points::Zero(3, 2);
    poison(1, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(deformer->set_targets(*handle, poison)).message().c_str() == Contains("targets[1]"));
    Motion no_axis;
    no_axis.axis.setZero();
    CHECK_FALSE(deformer->move_handle(*handle, no_axis).ok());
    CHECK_FALSE(deformer->move_handle(99, Motion{}).ok());
    CHECK_FALSE(deformer->remove_handle(99).ok());
    CHECK_FALSE(deformer->step(0.0).ok());
    Motion motion;
    motion.translation = {0.1, 0, 0};
    REQUIRE(deformer->move_handle(*handle, motion).ok());
    test::settle(*deformer);
    CHECK(deformer->positions().allFinite());
    REQUIRE(deformer->remove_handle(*handle).ok());
    CHECK(deformer->step().ok());
  }
}
