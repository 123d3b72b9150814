#include "pliant/deformers/rigid_cells/cell_tree.h"

#include <algorithm>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/deformers/rigid_cells/model.h"
#include "support/shapes.h"

using namespace pliant;
using namespace pliant::cells;

namespace {

CellTree tree_of(const test::Mesh& mesh, const RigidCellsOptions& options) {
  auto tree = CellTree::create(*test::shape_of(mesh), options);
  REQUIRE(tree.ok());
  return std::move(*tree);
}

double volume(const CellTree& tree) {
  double sum = 0.0;
  for (Index i = 0; i < tree.size(); ++i) sum += std::pow(tree.side(i), tree.frame().dimension);
  return sum;
}

/// The area cells share, found from their boxes alone.
double shared_area(const CellTree& tree, Index i, Index j) {
  const Eigen::Vector3d apart =
      (tree.frame().to_grid(tree.center(i)) - tree.frame().to_grid(tree.center(j))) * tree.frame().unit;
  double area = 1.0;
  int touching = 0;
  for (int axis = 0; axis < tree.frame().dimension; ++axis) {
    const double overlap =
        std::min({(tree.side(i) + tree.side(j)) / 2.0 - std::abs(apart[axis]), tree.side(i), tree.side(j)});
    if (overlap < -1e-9) return 0.0;
    if (overlap < 1e-9) {
      ++touching;
    } else {
      area *= overlap;
    }
  }
  return touching == 1 ? area : 0.0;
}

}  // namespace

TEST_CASE("a box is filled by cells of its volume, refined at its boundary, in balance") {
  const test::Mesh box = test::box(2.0, 1.0, 1.0, 0.25);
  for (const int levels : {0, 1, 2, 3}) {
    CAPTURE(levels);
    const CellTree tree = tree_of(box, {.resolution = 8, .boundary_levels = levels});
    CHECK(volume(tree) == doctest::Approx(2.0).epsilon(1e-4));
    int deepest = 0;
    for (Index i = 0; i < tree.size(); ++i) deepest = std::max(deepest, tree.level(i));
    CHECK(deepest == levels);
    for (const CellPair& pair : tree.pairs()) CHECK(std::abs(tree.level(pair.i) - tree.level(pair.j)) <= 1);
  }
}

TEST_CASE("pairs are the faces that cells share, each once, with weights of the shared area over the distance") {
  const CellTree tree = tree_of(test::sphere(3), {.resolution = 8, .align = false, .boundary_levels = 1});
  std::set<std::pair<Index, Index>> listed;
  for (const CellPair& pair : tree.pairs()) {
    CHECK(pair.i < pair.j);
    CHECK(listed.insert({pair.i, pair.j}).second);
    const double distance = (tree.side(pair.i) + tree.side(pair.j)) / 2.0;
    CHECK(pair.weight == doctest::Approx(shared_area(tree, pair.i, pair.j) / distance));
  }
  for (Index i = 0; i < tree.size(); ++i) {
    for (Index j = i + 1; j < tree.size(); ++j) {
      const bool joined = listed.count({i, j}) > 0;
      const bool touching = shared_area(tree, i, j) > 0.0;
      if (joined) CHECK(touching);
      // Only cells of the finest level may touch without being a pair.
      if (touching && !joined) CHECK(tree.level(i) + tree.level(j) == 2);
    }
  }
}

TEST_CASE("two legs side by side are not glued, their trunk is one") {
  // A trunk with two legs, a gap of a fifth of a leg between them.
  test::Mesh shape = test::box(2.2, 1.0, 1.0, 0.2);
  const auto leg = [](double x) {
    return test::transformed(test::box(1.0, 1.0, 3.0, 0.2), 1.0, Eigen::Matrix3d::Identity(), {x, 0, -2.9});
  };
  shape = test::both(shape, test::both(leg(0.0), leg(1.2)));
  const CellTree tree = tree_of(shape, {.resolution = 20, .align = false, .boundary_levels = 0});
  const auto right = [&](Index i) { return tree.center(i).x() > 1.1; };
  int across_legs = 0, across_trunk = 0;
  for (const CellPair& pair : tree.pairs()) {
    if (right(pair.i) == right(pair.j)) continue;
    (tree.center(pair.i).z() < -0.4 ? across_legs : across_trunk) += 1;
  }
  CHECK(across_legs == 0);
  CHECK(across_trunk > 0);
}

TEST_CASE("a soup and a tube open at both ends are filled; a shell is not") {
  const test::Mesh soup = test::soup(test::sphere(3));
  const CellTree solid = tree_of(soup, {.resolution = 16});
  CHECK(volume(solid) > 4.0);
  const CellTree shell = tree_of(soup, {.resolution = 16, .interior = false});
  CHECK(shell.size() < solid.size());
  CHECK(volume(shell) < 0.7 * volume(solid));
  for (Index i = 0; i < shell.size(); ++i) CHECK(std::abs(shell.center(i).norm() - 1.0) < shell.side(i));
  const CellTree tube = tree_of(test::tube(32, 40, 0.5, 4.0), {.resolution = 24, .align = false});
  CHECK(tube.cell_containing(tube.frame().to_grid({0.0, 0.0, 2.0})) >= 0);
}

TEST_CASE("points fill the space they enclose and hang together") {
  test::Mesh points = test::sphere(4);
  points.triangles.clear();
  const CellTree tree = tree_of(points, {.resolution = 12});
  CHECK(volume(tree) > 3.5);
  const CellModel model = cell_model(tree, *test::shape_of(points), std::vector<double>(points.vertices(), 1.0));
  const std::vector<Index> parts = model.parts();
  CHECK(*std::max_element(parts.begin(), parts.end()) == 0);
}

TEST_CASE("every vertex lies in a cell") {
  for (const auto& mesh : {test::potato(3), test::torus(30, 20), test::plane_grid(20, 9), test::tube(20, 30)}) {
    const CellTree tree = tree_of(mesh, {.resolution = 10, .boundary_levels = 2});
    for (Index v = 0; v < mesh.vertices(); ++v) {
      CHECK(tree.cell_containing(tree.frame().to_grid(mesh.vertex(v))) >= 0);
    }
  }
}

TEST_CASE("the grid turns with the shape, also where principal axes leave a turn open") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const auto& mesh : {test::potato(3), test::box(4.0, 1.0, 1.0, 0.25), test::box(1.0, 3.0, 2.0, 0.25)}) {
    const CellTree straight = tree_of(mesh, {.resolution = 12});
    const CellTree turned = tree_of(test::transformed(mesh, 3.0, turn, {5, 6, 7}), {.resolution = 12});
    CHECK(turned.size() == straight.size());
    CHECK(volume(turned) == doctest::Approx(27.0 * volume(straight)));
  }
}

TEST_CASE("splitting keeps balance and tells where cells come from; too many cells are refused") {
  CellTree tree = tree_of(test::box(1.0, 1.0, 1.0, 0.25), {.resolution = 4, .boundary_levels = 0, .refine = true});
  const Points before = tree.centers();
  const double side = tree.side(0);
  std::vector<bool> wanted(tree.size(), false);
  wanted[tree.cell_at({0.1, 0.1, 0.1})] = true;
  for (int round = 0; round < 2; ++round) {
    const auto origin = tree.split(wanted);
    REQUIRE(origin.ok());
    if (round == 0) {
      for (Index i = 0; i < tree.size(); ++i) {
        REQUIRE((*origin)[i].size() == 1);
        CHECK((tree.center(i) - before.col((*origin)[i][0])).cwiseAbs().maxCoeff() < side / 2.0);
      }
    }
    for (const CellPair& pair : tree.pairs()) CHECK(std::abs(tree.level(pair.i) - tree.level(pair.j)) <= 1);
    wanted.assign(tree.size(), false);
    wanted[tree.cell_at({0.1, 0.1, 0.1})] = true;
  }
  CHECK(volume(tree) == doctest::Approx(1.0).epsilon(1e-4));
  // Joining takes back no more than balance allows at once, and in the end all of it.
  int rounds = 0;
  for (Index size = -1; size != tree.size(); ++rounds) {
    size = tree.size();
    const Points finer = tree.centers();
    const auto origins = tree.join(std::vector<bool>(tree.size(), true));
    for (Index i = 0; i < tree.size(); ++i) {
      CHECK((finer(Eigen::all, origins[i]).rowwise().mean() - tree.center(i)).norm() < 1e-9);
    }
    for (const CellPair& pair : tree.pairs()) CHECK(std::abs(tree.level(pair.i) - tree.level(pair.j)) <= 1);
  }
  CHECK(rounds > 2);
  CHECK(tree.centers() == before);
  const auto many = CellTree::create(*test::shape_of(test::sphere(3)), {.resolution = 200, .boundary_levels = 2});
  CHECK_FALSE(many.ok());
  CHECK(many.status().code() == ErrorCode::too_large);
}
