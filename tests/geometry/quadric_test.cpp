#include "pliant/geometry/quadric.h"

#include <vector>

#include <doctest/doctest.h>

namespace pliant {
namespace {

TEST_CASE("a quadric is the sum of weighted squared distances from its planes") {
  const std::vector<Eigen::Vector3d> normals = {{1, 0, 0}, {0, 0.6, 0.8}, Eigen::Vector3d(1, 2, 3).normalized()};
  const std::vector<double> weights = {1.0, 0.5, 2.0};
  const auto expected = [&](const Eigen::Vector3d& offset) {
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      sum += weights[i] * normals[i].dot(offset) * normals[i].dot(offset);
    }
    return sum;
  };
  Quadric quadric;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    quadric.add_plane(normals[i], weights[i]);
  }
  const Eigen::Vector3d offset(0.3, -0.2, 0.7);
  const Eigen::Vector3d further(-1.1, 0.4, 0.2);
  CHECK(quadric.at(Eigen::Vector3d::Zero()) == 0.0);
  CHECK(quadric.at(offset) == doctest::Approx(expected(offset)));
  CHECK(quadric.about(offset).at(further) == doctest::Approx(expected(offset + further)));
  CHECK(quadric.about(offset).about(-offset).at(further) == doctest::Approx(expected(further)));

  Quadric sum = quadric.about(offset);
  sum.add(quadric);
  CHECK(sum.at(further) == doctest::Approx(expected(offset + further) + expected(further)));
}

}  // namespace
}  // namespace pliant
