#include "pliant/deformers/embedded_graph/deformer.h"

#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "support/edits.h"

using namespace pliant;
using test::distance;

namespace {

std::unique_ptr<EmbeddedGraph> make(const test::Mesh& mesh, const EmbeddedGraphOptions& options) {
  auto deformer = EmbeddedGraph::create(test::shape_of(mesh), options);
  REQUIRE(deformer.ok());
  return std::move(*deformer);
}

double least_determinant(const Deformer& deformer) {
  const State state = deformer.save();
  const auto& r = state.find("rotations")->data;
  double least = 1e9;
  for (std::size_t i = 0; i < r.size(); i += 9) {
    least = std::min(least, Eigen::Map<const Eigen::Matrix3d>(r.data() + i).determinant());
  }
  return least;
}

/// The paper's figure 3: left tenth fixed, right twentieth lifted.
struct BumpyEdit {
  test::Mesh mesh;
  std::unique_ptr<EmbeddedGraph> deformer;
  HandleId handle;

  BumpyEdit(int n, const EmbeddedGraphOptions& options, double lift) : mesh(test::bumpy_plane(n, 8, 0.02)) {
    deformer = make(mesh, options);
    REQUIRE(deformer->set_fixed(test::pick(mesh, [](const auto& p) { return p.x() <= 0.1; })).ok());
    handle = *deformer->add_handle(test::pick(mesh, [](const auto& p) { return p.x() >= 0.95; }));
    Motion up;
    up.translation = {0, 0, lift};
    REQUIRE(deformer->move_handle(handle, up).ok());
  }
};

}  // namespace

TEST_CASE("the fast solver reaches the energy of Gauss-Newton") {
  for (double lift : {0.3, 0.5}) {
    BumpyEdit fast(61, {.node_count = 150}, lift);
    BumpyEdit reference(61, {.node_count = 150, .solver = EmbeddedGraphSolver::gauss_newton}, lift);
    test::settle(*fast.deformer, 200, 1e-12);
    test::settle(*reference.deformer, 60, 1e-12);
    CHECK(fast.deformer->energy().total == doctest::Approx(reference.deformer->energy().total).epsilon(1e-4));
    CHECK(distance(fast.deformer->positions(), reference.deformer->positions()) < 1e-3);
    // Gauss-Newton refactorises at each step, the fast solver never while dragging.
    CHECK(fast.deformer->counters().factorizations == 1);
    CHECK(reference.deformer->counters().analyses == 1);
  }
}

TEST_CASE("terms that fell by orders of magnitude are reported to all their digits") {
  const test::Mesh mesh = test::potato(4);
  const auto grab = [&](EmbeddedGraph& deformer) {
    REQUIRE(deformer.set_fixed(test::pick(mesh, [](const auto& p) { return p.z() < -0.6; })).ok());
    return *deformer.add_handle(test::pick(mesh, [](const auto& p) { return p.z() > 0.1; }));
  };
  const auto solved = make(mesh, {.node_count = 100, .constraint_weight = 1e4});
  REQUIRE(solved->move_handle(grab(*solved), test::turn(80, {1, 0.2, 0}, {0, 0, -0.5})).ok());
  test::settle(*solved);
  const auto recomputed = make(mesh, {.node_count = 100, .constraint_weight = 1e4});
  grab(*recomputed);
  REQUIRE(recomputed->restore(solved->save()).ok());
  const Energy energy = solved->energy(), expected = recomputed->energy();
  for (std::size_t i = 0; i < expected.terms.size(); ++i) {
    CAPTURE(expected.terms[i].name);
    const double value = expected.terms[i].value;
    CHECK(std::abs(energy.terms[i].value - value) <= 1e-9 * value);
  }
}

TEST_CASE("Gauss-Newton converges as in the paper, about six iterations") {
  BumpyEdit edit(61, {.node_count = 200, .solver = EmbeddedGraphSolver::gauss_newton}, 0.3);
  const StepReport report = test::settle(*edit.deformer, 100, 1e-6);
  CHECK(report.converged);
  CHECK(report.iteration <= 8);
}

TEST_CASE("fixed regions stay bit for bit and shrink the system") {
  BumpyEdit edit(41, {.node_count = 120}, 0.4);
  test::settle(*edit.deformer);
  const Points rest = edit.deformer->shape().points();
  const Points now = edit.deformer->positions();
  for (Index v = 0; v < rest.cols(); ++v) {
    if (rest(0, v) <= 0.1) CHECK(now.col(v) == rest.col(v));
  }
  const State state = edit.deformer->save();
  const auto frozen = static_cast<Index>(state.find("frozen")->data.size());
  CHECK(frozen > 0);
  CHECK(edit.deformer->counters().unknowns == 12 * (120 - frozen));
}

TEST_CASE("the state tells the energy of each node") {
  BumpyEdit edit(41, {.node_count = 60}, 0.4);
  CHECK(edit.deformer->save().find("energies")->data == std::vector<double>(60, 0.0));
  test::settle(*edit.deformer);
  const State state = edit.deformer->save();
  double sum = 0.0;
  for (const double energy : state.find("energies")->data) sum += energy;
  const Energy energy = edit.deformer->energy();
  CHECK(sum == doctest::Approx(energy.terms[0].weight * energy.terms[0].value +
                               energy.terms[1].weight * energy.terms[1].value));
  CHECK(sum > 0.0);
}

TEST_CASE("other fixed vertices that leave as many nodes free, but other edges between them") {
  const auto mesh = test::plane_grid(5, 3);
  const auto deformer = make(mesh, {.solver = EmbeddedGraphSolver::gauss_newton});
  REQUIRE(deformer->add_handle(std::vector<Index>{14}).ok());
  for (Index fixed : {11, 0, 7, 4}) {
    REQUIRE(deformer->set_fixed(std::vector<Index>{fixed}).ok());
    CHECK(deformer->step().ok());
  }
}

TEST_CASE("no node turns inside out when handles turn far at once") {
  const auto mesh = test::tube(20, 60, 0.1, 2.0);
  for (auto solver : {EmbeddedGraphSolver::automatic, EmbeddedGraphSolver::gauss_newton}) {
    for (double degrees : {120.0, 150.0, 179.0, 270.0}) {
      for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0)}) {
        CAPTURE(degrees);
        const auto deformer = make(mesh, {.node_count = 80, .solver = solver});
        const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
        REQUIRE(deformer->move_handle(handle, test::turn(degrees, axis, {0, 0, 1.5})).ok());
        for (int i = 0; i < 40; ++i) {
          const auto report = deformer->step(1e-6);
          REQUIRE(report.ok());
          CHECK(least_determinant(*deformer) > 0.0);
          if (report->converged) break;
        }
        CHECK(std::isfinite(deformer->energy().total));
      }
    }
  }
}

TEST_CASE("both solvers end in the same minimum where nodes are about to collapse") {
  const auto mesh = test::tube(16, 40, 0.3, 1.5);
  for (double degrees : {80.0, 110.0}) {
    CAPTURE(degrees);
    std::vector<double> energies;
    for (auto solver : {EmbeddedGraphSolver::automatic, EmbeddedGraphSolver::gauss_newton}) {
      const auto deformer = make(mesh, {.node_count = 200, .solver = solver});
      const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
      REQUIRE(deformer->move_handle(handle, test::turn(degrees, {1, 0, 0.3}, {0, 0, 1.5}, {0.2, 0, -0.5})).ok());
      CHECK(test::settle(*deformer, 1000, 1e-6).converged);
      const Energy energy = deformer->energy();
      CHECK(energy.terms.back().name == "barrier");
      energies.push_back(energy.total);
      CHECK(least_determinant(*deformer) < 0.1);
    }
    CHECK(energies[0] == doctest::Approx(energies[1]).epsilon(1e-4));
  }
}

TEST_CASE("targets given as positions know turns up to half a turn") {
  const auto mesh = test::tube(20, 60, 0.15, 2.0);
  const auto by_motion = make(mesh, {.node_count = 80}), by_targets = make(mesh, {.node_count = 80});
  const Motion motion = test::turn(110, {1, 0, 0}, {0, 0, 1});
  const HandleId a = test::fix_bottom_grab_top(*by_motion, mesh);
  const HandleId b = test::fix_bottom_grab_top(*by_targets, mesh);
  REQUIRE(by_motion->move_handle(a, motion).ok());
  Points targets = by_targets->handles().front().rest;
  for (auto column : targets.colwise()) column = motion.apply(column);
  REQUIRE(by_targets->set_targets(b, targets).ok());
  test::settle(*by_motion);
  test::settle(*by_targets);
  CHECK(distance(by_motion->positions(), by_targets->positions()) < 1e-6);
}

TEST_CASE("exact handles are met where the graph can meet them") {
  for (auto solver : {EmbeddedGraphSolver::automatic, EmbeddedGraphSolver::gauss_newton}) {
    const auto mesh = test::potato(3);
    EmbeddedGraphOptions options{.node_count = 60, .solver = solver};
    auto violation = [&](bool exact) {
      options.exact_handles = exact;
      const auto deformer = make(mesh, options);
      REQUIRE(deformer->set_fixed(test::pick(mesh, [](const auto& p) { return p.z() < -0.6; })).ok());
      const HandleId handle = *deformer->add_handle(std::vector<Index>{5});
      Motion motion;
      motion.translation = {0.3, 0.2, 0.5};
      REQUIRE(deformer->move_handle(handle, motion).ok());
      test::settle(*deformer, 400, 1e-8);
      return (deformer->positions().col(5) - motion.apply(mesh.vertex(5))).norm() / deformer->shape().diagonal();
    };
    CHECK(violation(false) > 1e-4);  // a soft constraint leaves a gap ...
    CHECK(violation(true) < 1e-8);   // ... an exact one none
  }
}

TEST_CASE("exact handles are met by regions that turn, in at most twice the steps of soft ones") {
  const auto mesh = test::tube(24, 60, 0.3, 2.0);
  for (auto solver : {EmbeddedGraphSolver::automatic, EmbeddedGraphSolver::gauss_newton}) {
    EmbeddedGraphOptions options{.node_count = 150, .solver = solver};
    int soft_steps = 0;
    for (bool exact : {false, true}) {
      options.exact_handles = exact;
      const auto deformer = make(mesh, options);
      const HandleId id = test::fix_bottom_grab_top(*deformer, mesh);
      REQUIRE(deformer->move_handle(id, test::turn(75, {1, 0, 0.2}, {0, 0, 2}, {0.2, 0.1, -0.1})).ok());
      const StepReport report = test::settle(*deformer, 400, 1e-6);
      CHECK(report.converged);
      const Handle& handle = deformer->handles().front();
      const double gap = distance(deformer->point_positions()(Eigen::all, handle.points), handle.targets);
      if (!exact) soft_steps = report.iteration;
      if (!exact) continue;
      CHECK(gap < 1e-5 * deformer->shape().diagonal());
      CHECK(report.iteration <= 2 * soft_steps);
    }
  }
}

TEST_CASE("exact handles that contradict each other end without blowing up") {
  const auto mesh = test::potato(3);
  const auto deformer = make(mesh, {.node_count = 6, .exact_handles = true});
  // More targets, all over the place, than 6 nodes can meet.
  std::vector<Index> vertices;
  for (Index v = 0; v < mesh.vertices(); v += 3) vertices.push_back(v);
  const HandleId handle = *deformer->add_handle(vertices);
  Points targets = deformer->handles().front().rest;
  for (Index i = 0; i < targets.cols(); ++i) targets(2, i) += 0.2 * std::sin(13.0 * i);
  REQUIRE(deformer->set_targets(handle, targets).ok());
  test::settle(*deformer, 300, 1e-6);
  CHECK(deformer->positions().allFinite());
  CHECK(deformer->positions().cwiseAbs().maxCoeff() < 10.0);
}

TEST_CASE("a component without a handle stays, and one with a handle follows it") {
  const auto mesh =
      test::both(test::potato(2), test::transformed(test::potato(2), 1.0, Eigen::Matrix3d::Identity(), {50, 0, 0}));
  const auto deformer = make(mesh, {.node_count = 60});
  const Index half = mesh.vertices() / 2;
  const HandleId handle = *deformer->add_handle(std::vector<Index>{0, 10, 20, 30});
  const Motion motion = test::turn(70, {0, 0, 1}, {0, 0, 0}, {0, 1, 0});
  REQUIRE(deformer->move_handle(handle, motion).ok());
  test::settle(*deformer);
  for (Index v = 0; v < half; ++v) {
    CHECK((deformer->positions().col(v) - motion.apply(mesh.vertex(v))).norm() < 1e-6);
    CHECK((deformer->positions().col(half + v) - mesh.vertex(half + v)).norm() < 1e-6);
  }
}

TEST_CASE("a path of nodes and a single node are solvable") {
  // Nodes on a line leave the turn about it free.
  const auto mesh = test::tube(8, 30, 0.05, 1.0);
  Points line(3, 12);
  for (Index j = 0; j < 12; ++j) line.col(j) << 0, 0, j / 11.0;
  for (Index count : {12, 1}) {
    EmbeddedGraphOptions options{.sampling = NodeSampling::nodes, .nodes = line.leftCols(count)};
    const auto deformer = make(mesh, options);
    const HandleId handle = *deformer->add_handle(test::pick(mesh, [](const auto& p) { return p.z() > 0.9; }));
    const HandleId hold = *deformer->add_handle(test::pick(mesh, [](const auto& p) { return p.z() < 0.1; }));
    Motion motion;
    motion.translation = {0.3, 0, 0};
    REQUIRE(deformer->move_handle(handle, motion).ok());
    REQUIRE(deformer->move_handle(hold, Motion{}).ok());
    test::settle(*deformer);
    CHECK(deformer->positions().allFinite());
    CHECK(deformer->energy().total < 100.0 * 0.09 * 400 * 16);
  }
}

TEST_CASE("points, soup and the plane are deformed like the mesh they come from") {
  const auto mesh = test::plane_grid(21, 21);
  const auto vertices = test::pick(mesh, [](const auto& p) { return p.x() > 0.9; });
  const auto fixed = test::pick(mesh, [](const auto& p) { return p.x() < 0.1; });
  Motion motion = test::turn(40, {0, 0, 1}, {1, 0.5, 0}, {-0.1, 0.2, 0});
  std::vector<double> flat;
  for (Index v = 0; v < mesh.vertices(); ++v) flat.insert(flat.end(), {mesh.vertex(v).x(), mesh.vertex(v).y()});
  const auto plane = Shape::create(flat, mesh.triangles, 2);
  const auto cloud = Shape::create(mesh.positions, {});
  REQUIRE(plane.ok());
  REQUIRE(cloud.ok());
  std::vector<Points> results;
  Points nodes(3, 30);
  for (Index j = 0; j < 30; ++j) nodes.col(j) << (j % 6 + 0.5) / 6, (j / 6 + 0.5) / 5, 0;
  for (const auto& shape : {test::shape_of(mesh), *plane, *cloud}) {
    auto deformer = EmbeddedGraph::create(shape, {.sampling = NodeSampling::nodes, .nodes = nodes});
    REQUIRE(deformer.ok());
    REQUIRE((*deformer)->set_fixed(fixed).ok());
    REQUIRE((*deformer)->add_handle(vertices).ok());
    REQUIRE((*deformer)->move_handle(1, motion).ok());
    test::settle(**deformer);
    results.push_back((*deformer)->positions());
    CHECK(results.back().row(2).cwiseAbs().maxCoeff() == 0.0);  // nothing leaves the plane
  }
  CHECK(distance(results[0], results[1]) < 1e-12);
  CHECK(distance(results[0], results[2]) < 1e-12);
}

TEST_CASE("normals turn with the shape (eq. 3)") {
  const auto mesh = test::potato(3);
  const auto deformer = make(mesh, {.node_count = 60});
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(30, {1, 0, 0}, {0, 0, 0})).ok());
  test::settle(*deformer);
  const Points normals = deformer->normals();
  const auto bent = Shape::create(std::span(deformer->positions().eval().data(), 3 * mesh.vertices()), mesh.triangles);
  const Points expected = (*bent)->scatter((*bent)->normals());
  double mean = 0.0;
  for (Index v = 0; v < normals.cols(); ++v) {
    CHECK(normals.col(v).norm() == doctest::Approx(1.0));
    mean += normals.col(v).dot(expected.col(v)) / static_cast<double>(normals.cols());
  }
  CHECK(mean > 0.995);
}

TEST_CASE("the shape's own points carried as foreign points arrive where the shape does") {
  const auto mesh = test::potato(3);
  const auto deformer = make(mesh, {.node_count = 60});
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(50, {0, 1, 0}, {0, 0, 0.3})).ok());
  test::settle(*deformer);
  const auto carried = deformer->transform_points(deformer->shape().points());
  REQUIRE(carried.ok());
  CHECK(distance(*carried, deformer->point_positions()) == 0.0);
}

TEST_CASE("refinement adds nodes where the terms are high and lowers what a coarse graph cannot bend") {
  const auto mesh = test::tube(24, 80, 0.1, 2.0);
  const auto deformer = make(mesh, {.node_count = 24});
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(90, {1, 0, 0}, {0, 0, 1})).ok());
  CHECK(*deformer->refine(10) == 0);  // nothing solved yet
  test::settle(*deformer);
  const Points before = deformer->positions();
  CHECK_FALSE(deformer->refine(0).ok());
  const auto added = deformer->refine(30);
  REQUIRE(added.ok());
  CHECK(*added > 0);
  CHECK(*added <= 30);
  CHECK(deformer->save().find("nodes")->data.size() == 3 * (24 + *added));
  // The deformation carries over, up to the change of blend.
  CHECK(distance(deformer->positions(), before) < 0.1);
  const StepReport report = test::settle(*deformer);
  CHECK(report.converged);
  CHECK(least_determinant(*deformer) > 0.0);
  CHECK(deformer->handles().front().targets(1, 0) != deformer->handles().front().rest(1, 0));
}

TEST_CASE("a state with nonsense in it is refused and nothing changes") {
  const auto mesh = test::potato(2);
  const auto deformer = make(mesh, {.node_count = 30});
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(30, {1, 0, 0}, {0, 0, 0})).ok());
  test::settle(*deformer);
  const Points bent = deformer->positions();
  for (const char* name : {"nodes", "rotations", "translations"}) {
    State state = deformer->save();
    for (StateTable& table : state.tables) {
      if (table.name == name) table.data.pop_back();
    }
    CHECK(deformer->restore(state).code() == ErrorCode::invalid_option);
    state = deformer->save();
    for (StateTable& table : state.tables) {
      if (table.name == name) table.data[1] = std::numeric_limits<double>::infinity();
    }
    CHECK(deformer->restore(state).code() == ErrorCode::invalid_option);
    CHECK(deformer->positions() == bent);
  }
}
