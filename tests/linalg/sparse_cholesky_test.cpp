#include "pliant/linalg/sparse_cholesky.h"

#include <set>

#include <Eigen/Cholesky>
#include <doctest/doctest.h>

#include "support/dense.h"
#include "support/random.h"

using namespace pliant;
using test::dense;

namespace {

/// A random graph of about `degree` neighbours a node, diagonally dominant.
BlockMatrix random_matrix(int block, Index nodes, int degree, std::uint32_t seed) {
  test::Random random(seed);
  std::set<Edge> edges;
  for (Index j = 0; j < nodes && nodes > 1; ++j) {
    for (int d = 0; d < degree / 2; ++d) {
      // Mostly near neighbours, as in a graph over a surface.
      const Index k = (j + 1 + random.below(d == 0 ? nodes - 1 : std::min<Index>(nodes - 1, 6))) % nodes;
      if (k != j) edges.insert({std::min(j, k), std::max(j, k)});
    }
  }
  BlockMatrix matrix;
  matrix.set_zero(block, nodes, {edges.begin(), edges.end()});
  for (double& v : matrix.off_diagonal) v = random.number();
  for (double& v : matrix.diagonal) v = random.number();
  for (Index j = 0; j < nodes; ++j) {
    for (int i = 0; i < block; ++i) matrix.diagonal_block(j)[i * block + i] = 4.0 * block * (degree + 1);
  }
  return matrix;
}

}  // namespace

TEST_CASE("sparse Cholesky solves what a dense one solves") {
  for (int block : {1, 2, 3, 4, 12}) {
    for (Index nodes : {1, 2, 5, 40, 90}) {
      for (int degree : {0, 2, 6}) {
        for (int columns : {1, 3, 5}) {
          CAPTURE(block);
          CAPTURE(nodes);
          CAPTURE(degree);
          const BlockMatrix matrix = random_matrix(block, nodes, degree, 7 * nodes + degree);
          SparseCholesky cholesky;
          REQUIRE(cholesky.analyze(matrix).ok());
          REQUIRE(cholesky.factorize(matrix).ok());
          const Eigen::MatrixXd b = test::Random(3).vector(nodes * block * columns).reshaped(nodes * block, columns);
          Eigen::MatrixXd x = b;
          cholesky.solve(x.data(), columns);
          const Eigen::MatrixXd oracle = dense(matrix).llt().solve(b);
          CHECK((x - oracle).norm() <= 1e-12 * oracle.norm());
        }
      }
    }
  }
}

TEST_CASE("a reused factorisation gives what a fresh one gives, bit for bit") {
  const BlockMatrix first = random_matrix(4, 60, 6, 1);
  BlockMatrix second = first;
  for (double& v : second.off_diagonal) v *= 0.5;
  SparseCholesky reused, fresh;
  REQUIRE(reused.analyze(first).ok());
  REQUIRE(reused.factorize(first).ok());
  REQUIRE(reused.factorize(second).ok());
  REQUIRE(fresh.analyze(second).ok());
  REQUIRE(fresh.factorize(second).ok());
  Eigen::VectorXd a = test::Random(5).vector(first.nodes * 4), b = a;
  reused.solve(a.data(), 1);
  fresh.solve(b.data(), 1);
  CHECK(a == b);
}

TEST_CASE("an order taken over from blocks of another size serves as well") {
  const BlockMatrix blocks = random_matrix(4, 50, 6, 3);
  BlockMatrix scalars;
  scalars.set_zero(1, blocks.nodes, blocks.edges);
  scalars.diagonal.assign(50, 9.0);
  scalars.off_diagonal.assign(scalars.edges.size(), -0.7);
  SparseCholesky of_blocks, of_scalars;
  REQUIRE(of_blocks.analyze(blocks).ok());
  REQUIRE(of_scalars.analyze_like(of_blocks, scalars).ok());
  REQUIRE(of_scalars.factorize(scalars).ok());
  const Eigen::VectorXd b = test::Random(2).vector(50);
  Eigen::VectorXd x = b;
  of_scalars.solve(x.data(), 1);
  CHECK((dense(scalars) * x - b).norm() < 1e-13 * b.norm());
}

TEST_CASE("a matrix that is not positive definite is refused, and the next one is factorised") {
  BlockMatrix matrix = random_matrix(3, 20, 4, 2);
  SparseCholesky cholesky;
  REQUIRE(cholesky.analyze(matrix).ok());
  BlockMatrix indefinite = matrix;
  indefinite.diagonal_block(11)[4] = -1.0;
  const Status status = cholesky.factorize(indefinite);
  CHECK(status.code() == ErrorCode::not_solvable);
  BlockMatrix poisoned = matrix;
  poisoned.diagonal_block(3)[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(cholesky.factorize(poisoned).ok());
  REQUIRE(cholesky.factorize(matrix).ok());
  const Eigen::VectorXd b = test::Random(9).vector(60);
  Eigen::VectorXd x = b;
  cholesky.solve(x.data(), 1);
  CHECK((dense(matrix) * x - b).norm() < 1e-11 * b.norm());
}

TEST_CASE("separate parts and isolated nodes are one system") {
  BlockMatrix matrix;
  matrix.set_zero(1, 5, {{0, 1}, {3, 4}});
  matrix.diagonal = {2, 2, 4, 2, 2};
  matrix.off_diagonal = {1, -1};
  SparseCholesky cholesky;
  REQUIRE(cholesky.analyze(matrix).ok());
  REQUIRE(cholesky.factorize(matrix).ok());
  Eigen::VectorXd x(5);
  x << 3, 3, 8, 1, 1;
  cholesky.solve(x.data(), 1);
  const Eigen::VectorXd expected = (Eigen::VectorXd(5) << 1, 1, 2, 1, 1).finished();
  CHECK((x - expected).norm() < 1e-14);
}

TEST_CASE("solved roughly: six digits where pivots are alike, all of them where they are not") {
  for (double spread : {1.0, 1e12}) {
    for (double scale : {1e-150, 1.0, 1e150}) {
      BlockMatrix matrix = random_matrix(1, 300, 6, 11);
      matrix.diagonal[17] *= spread;
      SparseCholesky cholesky;
      REQUIRE(cholesky.analyze(matrix).ok());
      REQUIRE(cholesky.factorize(matrix).ok());
      cholesky.allow_rough();
      Eigen::VectorXd exact = scale * test::Random(4).vector(3 * 300), rough = exact;
      cholesky.solve(exact.data(), 3);
      cholesky.solve_roughly(rough.data());
      // Scaled before the norm is taken, whose squares would overflow.
      const double error = ((rough - exact) / scale).norm() / (exact / scale).norm();
      CHECK(error < 1e-6);
      CHECK((error == 0.0) == (spread > 1.0));
    }
  }
  // Zero stays zero, and a factorisation after the permission is exact again.
  const BlockMatrix matrix = random_matrix(1, 40, 6, 2);
  SparseCholesky cholesky;
  REQUIRE(cholesky.analyze(matrix).ok());
  REQUIRE(cholesky.factorize(matrix).ok());
  cholesky.allow_rough();
  Eigen::VectorXd zero = Eigen::VectorXd::Zero(120);
  cholesky.solve_roughly(zero.data());
  CHECK(zero.isZero(0.0));
  REQUIRE(cholesky.factorize(matrix).ok());
  Eigen::VectorXd a = test::Random(9).vector(120), b = a;
  cholesky.solve(a.data(), 3);
  cholesky.solve_roughly(b.data());
  CHECK(a == b);
}
