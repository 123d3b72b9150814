// Seeded numbers that are the same on every platform (the distributions of <random> are not).
#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace pliant::test {

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// In [-1, 1).
  double number() { return static_cast<double>(engine_()) / 2147483648.0 - 1.0; }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint32_t>(n)); }
  Eigen::VectorXd vector(Eigen::Index n) {
    Eigen::VectorXd v(n);
    for (double& x : v) x = number();
    return v;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace pliant::test
