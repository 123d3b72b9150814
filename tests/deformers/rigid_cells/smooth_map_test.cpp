#include "pliant/deformers/rigid_cells/smooth_map.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include "pliant/deformers/rigid_cells/blend.h"
#include "pliant/deformers/rigid_cells/model.h"
#include "pliant/geometry/closest_rotation.h"
#include "support/edits.h"
#include "support/random.h"
#include "support/shapes.h"

using namespace pliant;
using namespace pliant::cells;
using test::distance;

namespace {

struct Scene {
  std::shared_ptr<const Shape> shape;
  CellTree tree;
  CellModel model;
  std::vector<CellMotion> motions;

  explicit Scene(const test::Mesh& mesh, const RigidCellsOptions& options = {.resolution = 10})
      : shape(test::shape_of(mesh)), tree(std::move(*CellTree::create(*shape, options))) {
    model = cell_model(tree, *shape, std::vector<double>(shape->points().cols(), 1.0));
    motions = model.rest();
  }
  /// Every centre goes where the map takes it; cells keep their turns.
  template <class Map>
  void move_centers(const Map& map) {
    for (Index i = 0; i < model.size(); ++i) {
      motions[i].center = map(Eigen::Vector3d(model.centers.col(i) + model.origin)) - model.origin;
    }
  }
  Points carried(const Points& points) {
    SmoothMap map(tree);
    const SmoothMap::Places places = map.place(points);
    map.set_motions(motions, model.origin);
    Points out;
    map.carry(places, points, out);
    return out;
  }
};

}  // namespace

TEST_CASE("at rest every point stays, bit for bit") {
  Scene s(test::transformed(test::potato(3), 3.1, Eigen::Matrix3d::Identity(), {100, 3, 0.2}));
  CHECK(s.carried(s.shape->points()) == s.shape->points());
  Points out;
  carry(cell_maps(s.model.centers, s.motions), nearest_cells(s.tree.centers(), s.shape->points()), s.shape->points(),
        s.model.origin, out);
  CHECK(out == s.shape->points());
}

TEST_CASE("affine motions of the centres carry every point") {
  Scene s(test::potato(3), {.resolution = 10, .boundary_levels = 2});
  Eigen::Matrix3d linear;
  linear << 1.2, 0.3, -0.1, 0.0, 0.8, 0.2, 0.1, 0.0, 1.1;
  const auto affine = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return linear * x + Eigen::Vector3d(3, 1, 2);
  };
  s.move_centers(affine);
  Points expected = s.shape->points();
  for (auto column : expected.colwise()) column = affine(column);
  CHECK(distance(s.carried(s.shape->points()), expected) < 1e-6 * s.shape->diagonal());
}

TEST_CASE("a limb one cell thick turns with its cells, about its own axis, too") {
  Scene s(test::tube(12, 40, 0.04, 2.0), {.resolution = 16, .boundary_levels = 0});
  const Eigen::Matrix3d turn = rotation_of({0, 0, 1.0});
  for (Index i = 0; i < s.model.size(); ++i) s.motions[i] = {turn, turn * s.model.centers.col(i)};
  Points expected = s.shape->points();
  for (auto column : expected.colwise()) column = turn * (column - s.model.origin) + s.model.origin;
  CHECK(distance(s.carried(s.shape->points()), expected) < 1e-6 * s.shape->diagonal());
}

TEST_CASE("the map is close to the radial basis map through all centres") {
  Scene s(test::potato(3), {.resolution = 8, .boundary_levels = 1});
  const auto bend = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const double angle = 0.6 * x.z();
    return {x.x() * std::cos(angle) + x.z() * 0.2, x.y(), x.z() - x.x() * std::sin(angle)};
  };
  s.move_centers(bend);
  const Points centers = s.tree.centers();
  const Index n = static_cast<Index>(centers.cols());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4), right = Eigen::MatrixXd::Zero(n + 4, 3);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) system(i, j) = std::pow((centers.col(i) - centers.col(j)).norm(), 3);
    system.block<1, 4>(i, n) << 1.0, centers.col(i).transpose();
    system.block<4, 1>(n, i) = system.block<1, 4>(i, n).transpose();
    right.row(i) = (s.motions[i].center + s.model.origin - centers.col(i)).transpose();
  }
  const Eigen::MatrixXd solved = system.partialPivLu().solve(right);
  Points expected = s.shape->points();
  double farthest = 0.0;
  for (auto x : expected.colwise()) {
    Eigen::VectorXd row(n + 4);
    for (Index i = 0; i < n; ++i) row[i] = std::pow((x - centers.col(i)).norm(), 3);
    row.tail<4>() << 1.0, x;
    const Eigen::Vector3d move = solved.transpose() * row;
    farthest = std::max(farthest, move.norm());
    x += move;
  }
  CHECK(distance(s.carried(s.shape->points()), expected) < 0.01 * farthest);
}

TEST_CASE("points carried one by one, in any order, go where they go together") {
  Scene s(test::torus(30, 16));
  test::Random random(3);
  for (CellMotion& motion : s.motions) {
    motion.center += 0.05 * random.vector(3);
    motion.rotation = rotation_of(0.2 * random.vector(3));
  }
  const Points points = 1.5 * random.vector(300).reshaped(3, 100);  // many of them far outside
  const Points together = s.carried(points);
  for (Index p = 0; p < 100; p += 7) CHECK(s.carried(points.col(99 - p)) == together.col(99 - p));
}

TEST_CASE("two fingers side by side do not drag each other") {
  test::Mesh mesh = test::box(2.2, 1.0, 1.0, 0.2);
  const auto finger = [](double x) {
    return test::transformed(test::box(1.0, 1.0, 3.0, 0.2), 1.0, Eigen::Matrix3d::Identity(), {x, 0, -2.9});
  };
  mesh = test::both(mesh, test::both(finger(0.0), finger(1.2)));
  Scene s(mesh, {.resolution = 20, .align = false, .boundary_levels = 0});
  // The lower half of the left finger moves away, the right one stays.
  for (Index i = 0; i < s.model.size(); ++i) {
    const Eigen::Vector3d c = s.tree.center(i);
    if (c.x() < 1.1 && c.z() < -1.4) s.motions[i].center.x() -= 0.5;
  }
  const Points carried = s.carried(s.shape->points());
  for (Index p = 0; p < carried.cols(); ++p) {
    const Eigen::Vector3d rest = s.shape->points().col(p);
    const double move = (carried.col(p) - rest).norm();
    if (rest.x() > 1.15 && rest.z() < -1.0) CHECK(move < 1e-9);
    if (rest.x() < 1.05 && rest.z() < -2.4) CHECK(move == doctest::Approx(0.5).epsilon(1e-6));
  }
}
