#include "pliant/solve/carry.h"

#include <doctest/doctest.h>

#include "support/random.h"

using namespace pliant;

TEST_CASE("carrying points is eq. 2, for the unrolled and the general number of influences") {
  test::Random random(3);
  constexpr Index nodes = 9, points = 50;
  for (int k : {1, 3, 4, 7}) {
    Influences influences;
    influences.k = k;
    for (Index i = 0; i < points * k; ++i) {
      influences.indices.push_back(random.below(nodes));
      influences.weights.push_back(0.5 + 0.5 * random.number());
    }
    PackedMaps maps(12, nodes);
    std::vector<Eigen::Matrix3d> a;
    std::vector<Eigen::Vector3d> b;
    for (Index j = 0; j < nodes; ++j) {
      a.push_back(random.vector(9).reshaped(3, 3));
      b.push_back(random.vector(3));
      maps.col(j) = pack_map(a.back(), b.back());
    }
    const Points p = random.vector(3 * points).reshaped(3, points);
    const Eigen::Vector3d origin(0.3, -2.0, 1.0);
    Points out;
    carry(maps, influences, p, origin, out);
    Points expected = p;
    for (Index i = 0; i < points; ++i) {
      for (int s = 0; s < k; ++s) {
        const Index j = influences.indices[i * k + s];
        expected.col(i) += influences.weights[i * k + s] * (a[j] * (p.col(i) - origin) + b[j]);
      }
    }
    CHECK((out - expected).norm() < 1e-13 * expected.norm());
  }
}

TEST_CASE("maps of zero leave points where they are, bit for bit") {
  Influences influences{2, {0, 1, 1, 0}, {0.25, 0.75, 0.5, 0.5}};
  const Points p = 1e6 * test::Random(1).vector(6).reshaped(3, 2);
  Points out;
  carry(PackedMaps::Zero(12, 2), influences, p, {1e6, 3.0, 0.1}, out);
  CHECK(out == p);
}
