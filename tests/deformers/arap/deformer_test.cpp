// What ARAP does beyond the laws.
#include "pliant/deformers/arap/deformer.h"

#include <numbers>

#include <doctest/doctest.h>

#include "deformers/arap/reference.h"
#include "pliant/geometry/measure.h"
#include "support/edits.h"

using namespace pliant;

namespace {

std::unique_ptr<Arap> arap_of(const test::Mesh& mesh, const ArapOptions& options = {}) {
  auto deformer = Arap::create(test::shape_of(mesh), options);
  REQUIRE(deformer.ok());
  return std::move(*deformer);
}

std::vector<bool> held_by(const Deformer& deformer) {
  std::vector<bool> held(deformer.shape().points().cols(), false);
  for (Index p : deformer.fixed_points()) held[p] = true;
  for (const Handle& handle : deformer.handles()) {
    for (Index p : handle.points) held[p] = true;
  }
  return held;
}

}  // namespace

TEST_CASE("ARAP ends where the plain local-global loop ends, with no more folds") {
  const auto mesh = test::potato(2);
  for (auto energy : {ArapEnergy::spokes, ArapEnergy::spokes_and_rims}) {
    const auto deformer = arap_of(mesh, {.energy = energy});
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    REQUIRE(deformer->move_handle(handle, test::turn(60, {1, 0.2, 0}, {0, 0, 0.6}, {0, 0, 0.3})).ok());
    const test::ArapReference reference(deformer->shape(), energy == ArapEnergy::spokes_and_rims);
    Points x = deformer->shape().points();
    x(Eigen::all, deformer->handles()[0].points) = deformer->handles()[0].targets;
    const double expected = reference.solve(x, held_by(*deformer), 3000);
    CHECK(test::settle(*deformer, 300, 1e-10).converged);
    CHECK(deformer->energy().total == doctest::Approx(expected).epsilon(1e-6));
    CHECK(test::distance(deformer->point_positions(), x) < 1e-3 * deformer->shape().diagonal());
    CHECK(measure_quality(deformer->shape(), deformer->point_positions()).folds <=
          measure_quality(deformer->shape(), x).folds);
  }
}

TEST_CASE("ARAP needs a tenth of the plain loop's iterations") {
  const auto mesh = test::tube(24, 60, 0.3, 4.0);
  const auto deformer = arap_of(mesh, {.energy = ArapEnergy::spokes_and_rims});
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(60, {1, 0, 0}, {0, 0, 3.8}, {0, 0.5, 0})).ok());
  const Points start = [&] {
    Points x = deformer->shape().points();
    x(Eigen::all, deformer->handles()[0].points) = deformer->handles()[0].targets;
    return x;
  }();
  test::settle(*deformer, 500, 1e-10);
  const double enough = deformer->energy().total * (1.0 + 1e-4);
  deformer->reset();
  REQUIRE(deformer->move_handle(handle, test::turn(60, {1, 0, 0}, {0, 0, 3.8}, {0, 0.5, 0})).ok());
  int iterations = 0;
  for (double energy = 2.0 * enough; energy > enough; ++iterations) energy = deformer->step()->energy;
  Points x = start;
  const test::ArapReference plain(deformer->shape(), true);
  CHECK(plain.solve(x, held_by(*deformer), 10 * iterations) > enough);
}

TEST_CASE("ARAP: handles are exact, or soft and the stiffer the closer") {
  const auto mesh = test::potato(3);
  double last = 10.0;
  for (double weight : {0.01, 1.0, 100.0, 0.0}) {
    ArapOptions options;
    if (weight > 0.0) options.constraint_weight = weight;
    const auto deformer = arap_of(mesh, options);
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    REQUIRE(deformer->move_handle(handle, test::turn(30, {0, 1, 0}, {0, 0, 0}, {0, 0, 0.5})).ok());
    test::settle(*deformer);
    const Handle& moved = deformer->handles()[0];
    const double miss = test::distance(deformer->point_positions()(Eigen::all, moved.points), moved.targets);
    CHECK(miss < 0.5 * last);
    last = miss;
    const Energy energy = deformer->energy();
    double sum = 0.0;
    for (const EnergyTerm& term : energy.terms) sum += term.weight * term.value;
    CHECK(energy.total == doctest::Approx(sum));
  }
  CHECK(last == 0.0);
}

TEST_CASE("ARAP: fixed points leave the system and stay at rest") {
  const auto mesh = test::potato(3);
  const auto deformer = arap_of(mesh);
  const auto fixed = test::pick(mesh, [](const auto& p) { return p.x() < 0.8; });
  REQUIRE(deformer->set_fixed(fixed).ok());
  REQUIRE(deformer->add_handle(test::pick(mesh, [](const auto& p) { return p.x() > 1.5; })).ok());
  REQUIRE(deformer->move_handle(1, test::turn(40, {0, 1, 0}, {1, 0, 0})).ok());
  test::settle(*deformer);
  const Index held = static_cast<Index>(fixed.size() + deformer->handles()[0].points.size());
  CHECK(deformer->counters().unknowns == 3 * (mesh.vertices() - held));
  const Points now = deformer->positions();
  for (Index v : fixed) CHECK(now.col(v) == mesh.vertex(v));
}

TEST_CASE("ARAP: a smooth energy makes a hill of a single-vertex handle, plain ARAP a spike") {
  const auto mesh = test::plane_grid(31, 31);
  double below[2];
  for (bool smooth : {false, true}) {
    const auto deformer = arap_of(mesh, {.smoothness = smooth ? 0.2 : 0.0});
    REQUIRE(deformer
                ->set_fixed(test::pick(mesh,
                                       [](const auto& p) {
                                         return std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.05;
                                       }))
                .ok());
    REQUIRE(deformer->add_handle(std::vector<Index>{15 * 31 + 15}).ok());
    Motion up;
    up.translation = {0, 0, 0.2};
    REQUIRE(deformer->move_handle(1, up).ok());
    test::settle(*deformer, 500);
    below[smooth] = 0.2 - deformer->positions()(2, 15 * 31 + 16);
  }
  CHECK(below[1] > 0.0);
  CHECK(below[1] < 0.5 * below[0]);
}

TEST_CASE("ARAP in the plane stays there, and bends without turning triangles over") {
  const auto mesh = test::plane_grid(9, 25, 1.0, 3.0);
  std::vector<double> flat;
  for (Index v = 0; v < mesh.vertices(); ++v) flat.insert(flat.end(), {mesh.vertex(v).x(), mesh.vertex(v).y()});
  const auto shape = Shape::create(flat, mesh.triangles, 2);
  REQUIRE(shape.ok());
  for (double degrees : {-20.0, 30.0}) {
    auto deformer = Arap::create(*shape, {});
    REQUIRE(deformer.ok());
    REQUIRE((*deformer)->set_fixed(test::pick(mesh, [](const auto& p) { return p.y() < 0.2; })).ok());
    REQUIRE((*deformer)->add_handle(test::pick(mesh, [](const auto& p) { return p.y() > 2.8; })).ok());
    REQUIRE((*deformer)->move_handle(1, test::turn(degrees, {0, 0, 1}, {1.5, 1.5, 0})).ok());
    CHECK(test::settle(**deformer, 500, 1e-9).converged);
    const Points now = (*deformer)->positions();
    CHECK(now.row(2).isZero(0.0));
    // No triangle is turned over.
    for (const auto t : (*shape)->triangles().colwise()) {
      const Eigen::Vector3d u = now.col(t[1]) - now.col(t[0]), v = now.col(t[2]) - now.col(t[0]);
      CHECK(u.x() * v.y() - u.y() * v.x() > 0.0);
    }
  }
}

TEST_CASE("ARAP: turns beyond half a turn are honoured") {
  // Not a perfect tube: that would also balance on saddles of the energy, as it does at 270 and 360
  // degrees, from where a tube with any flaw buckles and unwinds.
  auto mesh = test::tube(16, 40, 0.3, 4.0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] += 1e-4 * std::sin(static_cast<double>(i * i));
  for (double degrees : {190.0, -215.0, 240.0}) {
    const auto deformer = arap_of(mesh);
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    REQUIRE(deformer->move_handle(handle, test::turn(degrees, {0, 0, 1}, {0, 0, 0})).ok());
    test::settle(*deformer);
    const auto turn = [](const Points& of) {  // added up ring by ring
      double sum = 0.0;
      for (int j = 1; j < 40; ++j) {
        const Eigen::Vector3d a = of.col(16 * (j - 1)), b = of.col(16 * j);
        sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
      }
      return sum * 180.0 / std::numbers::pi;
    };
    const Points rest = deformer->shape().scatter(deformer->shape().points());
    CHECK(turn(deformer->positions()) - turn(rest) == doctest::Approx(degrees).epsilon(1e-6));
  }
}

TEST_CASE("ARAP: bad triangles, fins, loose points and parts nobody holds") {
  // A grid with a sliver, a triangle of no area, a fin on an inner edge, a loose point, and apart
  // from it all a second grid.
  test::Mesh mesh = test::plane_grid(8, 8);
  const auto add_point = [&](double x, double y, double z) {
    mesh.positions.insert(mesh.positions.end(), {x, y, z});
    return static_cast<std::uint32_t>(mesh.vertices() - 1);
  };
  const std::uint32_t on_edge = add_point(0.5 / 7, 1e-13, 0), fin = add_point(0.5, 0.5, 0.2);
  mesh.triangles.insert(mesh.triangles.end(), {0, 1, on_edge, 27, 28, fin});
  const std::uint32_t loose = add_point(3, 0, 0);
  mesh = test::both(mesh, test::transformed(test::plane_grid(4, 4), 1.0, Eigen::Matrix3d::Identity(), {0, 0, 5}));
  for (auto energy : {ArapEnergy::spokes, ArapEnergy::spokes_and_rims}) {
    const auto deformer = arap_of(mesh, {.energy = energy, .smoothness = 0.05});
    REQUIRE(deformer->set_fixed(std::vector<Index>{0, 8, 16, 24, 32, 40, 48, 56}).ok());
    REQUIRE(deformer->add_handle(std::vector<Index>{7, 15, 23, 31, 39, 47, 55, 63}).ok());
    REQUIRE(deformer->move_handle(1, test::turn(70, {0, 1, 0}, {1, 0, 0}, {0, 0, 0.2})).ok());
    test::settle(*deformer);
    const Points now = deformer->positions();
    CHECK(now.allFinite());
    for (Index v = static_cast<Index>(loose); v < now.cols(); ++v) {
      CHECK((now.col(v) - mesh.vertex(v)).norm() < 1e-12);
    }
    CHECK(now(2, 27) != 0.0);
  }
}

TEST_CASE("ARAP: what is let go relaxes to its shape") {
  const auto mesh = test::potato(2);
  const auto deformer = arap_of(mesh);
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(40, {0, 1, 0}, {0, 0, 0}, {0, 0, 0.3})).ok());
  test::settle(*deformer);
  REQUIRE(deformer->remove_handle(handle).ok());
  REQUIRE(deformer->set_fixed(std::vector<Index>{}).ok());
  test::settle(*deformer, 500, 1e-10);
  CHECK(deformer->energy().total < 1e-10);
}

TEST_CASE("ARAP: options change while the deformer lives, at the price the header tells") {
  const auto mesh = test::potato(2);
  const auto deformer = arap_of(mesh);
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(40, {0, 1, 0}, {0, 0, 0}, {0, 0, 0.3})).ok());
  const auto cost_of = [&](const ArapOptions& options) {
    const Counters before = deformer->counters();
    REQUIRE(deformer->set_options(options).ok());
    test::settle(*deformer, 300, 1e-12);
    const auto fresh = arap_of(mesh, options);
    test::fix_bottom_grab_top(*fresh, mesh);
    REQUIRE(fresh->move_handle(1, test::turn(40, {0, 1, 0}, {0, 0, 0}, {0, 0, 0.3})).ok());
    test::settle(*fresh, 300, 1e-12);
    CHECK(test::distance(deformer->positions(), fresh->positions()) < 1e-5);
    const Counters after = deformer->counters();
    return std::pair(after.factorizations - before.factorizations, after.analyses - before.analyses);
  };
  test::settle(*deformer);
  CHECK(cost_of({}) == std::pair(0, 0));
  CHECK(cost_of({.energy = ArapEnergy::spokes_and_rims}) == std::pair(1, 0));
  CHECK(cost_of({.constraint_weight = 10.0}) == std::pair(1, 1));
  CHECK(cost_of({.constraint_weight = 50.0}) == std::pair(1, 0));
  CHECK(cost_of({.constraint_weight = 50.0, .smoothness = 0.1}) == std::pair(1, 1));
  CHECK(cost_of({.smoothness = 0.2}) == std::pair(1, 1));
}

TEST_CASE("ARAP: the saved state gives the energy without Pliant") {
  const auto mesh = test::potato(2);
  const auto deformer = arap_of(test::soup(mesh));
  const HandleId handle = test::fix_bottom_grab_top(*deformer, test::soup(mesh));
  REQUIRE(deformer->move_handle(handle, test::turn(40, {0, 1, 0}, {0, 0, 0}, {0, 0, 0.3})).ok());
  test::settle(*deformer);
  const State state = deformer->save();
  const test::Mesh soup = test::soup(mesh);
  const auto &i = state.find("edges[]/i")->data, &j = state.find("edges[]/j")->data,
             &w = state.find("edges[]/weight")->data, &r = state.find("rotations")->data,
             &result = state.find("result")->data;
  REQUIRE(result.size() == soup.positions.size());
  double sum = 0.0;
  for (std::size_t e = 0; e < w.size(); ++e) {
    for (auto end : {i[e], j[e]}) {
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(&r[9 * static_cast<std::size_t>(end)]);
      const Eigen::Vector3d now = Eigen::Map<const Eigen::Vector3d>(&result[3 * static_cast<std::size_t>(i[e])]) -
                                  Eigen::Map<const Eigen::Vector3d>(&result[3 * static_cast<std::size_t>(j[e])]);
      const Eigen::Vector3d rest = soup.vertex(static_cast<Index>(i[e])) - soup.vertex(static_cast<Index>(j[e]));
      sum += w[e] * (now - turn * rest).squaredNorm();
    }
  }
  CHECK(sum == doctest::Approx(deformer->energy().total).epsilon(1e-9));
}

TEST_CASE("ARAP: bad options and shapes are named") {
  using doctest::Contains;
  const auto shape = test::shape_of(test::potato(1));
  for (double weight : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    const auto result = Arap::create(shape, {.constraint_weight = weight});
    CHECK(result.status().code() == ErrorCode::invalid_option);
    CHECK(result.status().message().c_str() == Contains("constraintWeight"));
  }
  CHECK(Arap::create(shape, {.smoothness = -0.1}).status().message().c_str() == Contains("smoothness"));
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto cloud = Shape::create(points, {});
  REQUIRE(cloud.ok());
  CHECK(Arap::create(*cloud, {}).status().code() == ErrorCode::invalid_shape);
  const auto deformer = arap_of(test::potato(1));
  CHECK(deformer->transform_points(Points::Zero(3, 1)).status().code() == ErrorCode::not_solvable);
}
