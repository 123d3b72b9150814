#include "pliant/solve/local_global.h"

#include <doctest/doctest.h>

using namespace pliant;

namespace {

/// |x_i - x_(i+1)| should be a length: springs along a path, directions are what is local.
class Chain final : public LocalModel {
 public:
  explicit Chain(Index points, double length) : points_(points), length_(length) {}

  BlockMatrix matrix() const override {
    BlockMatrix matrix;
    std::vector<Edge> edges;
    for (Index i = 0; i + 1 < points_; ++i) edges.push_back({i, i + 1});
    matrix.set_zero(1, points_, std::move(edges));
    for (std::size_t e = 0; e < matrix.edges.size(); ++e) {
      matrix.off_diagonal[e] = -1.0;
      for (Index end : matrix.edges[e]) matrix.diagonal[end] += 1.0;
    }
    return matrix;
  }
  double evaluate(const Points& x, Points& half_gradient) override {
    ++evaluations;
    half_gradient.setZero(3, x.cols());
    double energy = 0.0;
    for (Index i = 0; i + 1 < points_; ++i) {
      const Eigen::Vector3d d = x.col(i) - x.col(i + 1);
      const double longer = d.norm() - length_;
      energy += longer * longer;
      half_gradient.col(i) += longer * d.normalized();
      half_gradient.col(i + 1) -= longer * d.normalized();
    }
    return energy;
  }
  void turned_gradient(const Points&, const Rotations&, const Points&, Points&) const override {}
  double stiffness() const override { return 1.0; }

  int evaluations = 0;

 private:
  Index points_;
  double length_;
};

}  // namespace

TEST_CASE(
    "local-global kernel: what is held stays, every accepted step lowers the energy, the end is "
    "exact") {
  const Index n = 12;
  Chain chain(n, 1.0);
  Points x = Points::Zero(3, n);
  for (Index i = 0; i < n; ++i) x.col(i) << 0.7 * i, i % 3 * 0.1, i % 2 * 0.2;
  std::vector<bool> held(n, false);
  held[0] = held[n - 1] = true;
  const Eigen::Vector3d first = x.col(0), last = x.col(n - 1);
  LocalGlobal kernel;
  REQUIRE(kernel.set_up(chain.matrix(), held).ok());
  CHECK(kernel.unknowns() == 3 * (n - 2));
  Points unused;
  double energy = chain.evaluate(x, unused);
  LocalGlobal::Outcome outcome;
  for (int i = 0; i < 200 && !outcome.converged; ++i) {
    outcome = kernel.step(chain, x, 1e-12, 10.0, 1e-20);
    if (outcome.accepted) CHECK(kernel.energy() < energy);
    energy = kernel.energy();
  }
  CHECK(outcome.converged);
  CHECK(x.col(0) == first);
  CHECK(x.col(n - 1) == last);
  CHECK(energy < 1e-15);  // the chain is longer than the gap: it can keep all its lengths
  CHECK(kernel.factorizations() == 1);
  CHECK(kernel.analyses() == 1);
}

TEST_CASE("local-global kernel: values of held points extend linearly along a path") {
  const Index n = 9;
  std::vector<bool> held(n, false);
  held[2] = held[6] = true;
  LocalGlobal kernel;
  REQUIRE(kernel.set_up(Chain(n, 1.0).matrix(), held).ok());
  Points values = Points::Constant(3, n, 99.0);
  values.col(2) << 0, 1, 2;
  values.col(6) << 4, 1, -2;
  kernel.extend(values);
  for (Index i = 2; i <= 6; ++i) {
    CHECK((values.col(i) - Eigen::Vector3d(i - 2, 1, 4 - i)).norm() < 1e-12);
  }
  CHECK((values.col(0) - values.col(2)).norm() < 1e-12);
  CHECK((values.col(8) - values.col(6)).norm() < 1e-12);
}

TEST_CASE("local-global kernel: with everything held there is nothing to do") {
  Chain chain(3, 1.0);
  LocalGlobal kernel;
  REQUIRE(kernel.set_up(chain.matrix(), {true, true, true}).ok());
  Points x = Points::Zero(3, 3);
  x.row(0) << 0, 2, 4;
  const auto outcome = kernel.step(chain, x, 1e-6, 1.0, 0.0);
  CHECK_FALSE(outcome.accepted);
  CHECK(outcome.converged);
  CHECK(kernel.energy() == doctest::Approx(2.0));
}

TEST_CASE("parts of a matrix: each keeps one held point, and those held before are told apart") {
  BlockMatrix matrix;
  matrix.set_zero(1, 6, {{0, 3}, {1, 2}, {3, 5}});
  const std::vector<Index> parts = parts_of(matrix);
  CHECK(parts == std::vector<Index>{0, 1, 1, 0, 2, 0});
  std::vector<bool> held = {false, false, false, true, false, false};
  CHECK(hold_one_a_part(parts, held) == std::vector<bool>{true, false, false, true, false, true});
  CHECK(held == std::vector<bool>{false, true, false, true, true, false});
}
