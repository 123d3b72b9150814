#include "pliant/deformers/rigid_cells/multigrid.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;
using namespace pliant::cells;

namespace {

/// A block of cells, each pair tied by the inertia of a few random points around.
struct Block {
  std::vector<Eigen::Vector3i> corners;
  std::vector<Freedom> freedom;
  std::vector<std::array<Index, 2>> pairs;
  std::vector<Inertia> stiffness;
  Points pivots;

  Block(int nx, int ny, int nz, std::uint32_t seed) {
    test::Random random(seed);
    const auto id = [&](int x, int y, int z) { return x + nx * (y + ny * z); };
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          corners.emplace_back(x, y, z);
          if (x + 1 < nx) pairs.push_back({id(x, y, z), id(x + 1, y, z)});
          if (y + 1 < ny) pairs.push_back({id(x, y, z), id(x, y + 1, z)});
          if (z + 1 < nz) pairs.push_back({id(x, y, z), id(x, y, z + 1)});
        }
      }
    }
    freedom.assign(corners.size(), Freedom::free);
    pivots = random.vector(3 * static_cast<Index>(corners.size())).reshaped(3, corners.size());
    for (const auto& [i, j] : pairs) {
      Inertia inertia;
      const Eigen::Vector3d middle = 0.5 * (corners[i] + corners[j]).cast<double>();
      for (int k = 0; k < 4; ++k) inertia.add_point(1.5 + random.number(), middle + 0.5 * random.vector(3));
      stiffness.push_back(inertia);
    }
  }

  Eigen::MatrixXd dense() const {
    const Eigen::Index n = 6 * static_cast<Eigen::Index>(corners.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const auto [i, j] = pairs[p];
      const Eigen::Matrix<double, 6, 6> k = stiffness[p].dense();
      matrix.block<6, 6>(6 * i, 6 * i) += k;
      matrix.block<6, 6>(6 * j, 6 * j) += k;
      matrix.block<6, 6>(6 * i, 6 * j) -= k;
      matrix.block<6, 6>(6 * j, 6 * i) -= k;
    }
    return matrix;
  }

  /// Columns span the motions the cells are free to make.
  Eigen::MatrixXd motions() const {
    std::vector<Eigen::VectorXd> columns;
    const Eigen::Index n = 6 * static_cast<Eigen::Index>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (int k = 0; k < 6; ++k) {
        Eigen::VectorXd column = Eigen::VectorXd::Zero(n);
        if (freedom[i] == Freedom::held || (freedom[i] == Freedom::turns && k < 3)) continue;
        column[6 * static_cast<Eigen::Index>(i) + k] = 1.0;
        if (freedom[i] == Freedom::turns) {
          column.segment<3>(6 * static_cast<Eigen::Index>(i)) =
              -Eigen::Vector3d::Unit(k - 3).cross(Eigen::Vector3d(pivots.col(static_cast<Index>(i))));
        }
        columns.push_back(column);
      }
    }
    Eigen::MatrixXd all(n, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c) all.col(static_cast<Eigen::Index>(c)) = columns[c];
    return all;
  }

  int solve(Eigen::VectorXd& x, double tolerance) const {
    Multigrid multigrid;
    multigrid.set_up(corners, freedom, pairs);
    multigrid.stiffness() = stiffness;
    multigrid.prepare(pivots);
    return multigrid.solve(x, tolerance, 200);
  }
};

}  // namespace

TEST_CASE("solves are those of the dense system, with cells held whole and at points") {
  for (const int size : {1, 3, 6}) {
    CAPTURE(size);
    Block block(size + 2, size, size, 31);
    for (std::size_t i = 0; i < block.corners.size(); ++i) {
      if (block.corners[i].x() == 0) block.freedom[i] = Freedom::held;
      if (block.corners[i].x() == size + 1 && block.corners[i].y() == 0) block.freedom[i] = Freedom::turns;
    }
    test::Random random(33);
    Eigen::VectorXd b = random.vector(6 * static_cast<Eigen::Index>(block.corners.size()));
    for (std::size_t i = 0; i < block.corners.size(); ++i) {
      if (block.freedom[i] == Freedom::held) b.segment<6>(6 * static_cast<Eigen::Index>(i)).setZero();
    }
    const Eigen::MatrixXd free = block.motions();
    const Eigen::MatrixXd reduced = free.transpose() * block.dense() * free;
    const Eigen::VectorXd expected = free * reduced.ldlt().solve(free.transpose() * b);
    Eigen::VectorXd x = b;
    block.solve(x, 1e-10);
    CHECK((x - expected).norm() < 1e-6 * expected.norm());
  }
}

TEST_CASE("iterations hardly grow with the number of cells") {
  std::vector<int> iterations;
  for (const int size : {4, 8, 12}) {
    Block block(2 * size, size, size, 35);
    for (std::size_t i = 0; i < block.corners.size(); ++i) {
      if (block.corners[i].x() == 0) block.freedom[i] = Freedom::held;
    }
    Eigen::VectorXd x = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(block.corners.size()));
    x.tail<6>() << 1, 2, 3, 0, 1, -1;
    iterations.push_back(block.solve(x, 1e-6));
  }
  CAPTURE(iterations[0]);
  CAPTURE(iterations[2]);
  CHECK(iterations[2] <= iterations[0] + 12);
  CHECK(iterations[2] < 40);
}

TEST_CASE("what nothing holds stays solvable") {
  const Block block(5, 4, 3, 37);
  test::Random random(39);
  Eigen::VectorXd x = random.vector(6 * 60);
  // No net wrench.
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(6);
  for (int i = 0; i < 60; ++i) sum += x.segment<6>(6 * i);
  for (int i = 0; i < 60; ++i) x.segment<6>(6 * i) -= sum / 60.0;
  const Eigen::VectorXd b = x;
  block.solve(x, 1e-9);
  CHECK(x.allFinite());
  CHECK((block.dense() * x - b).norm() < 1e-5 * b.norm());
}
