#include "pliant/core/sort.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "support/random.h"

namespace pliant {
namespace {

TEST_CASE("keys are in the order of the numbers they stand for") {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> ascending = {-inf, -1e300, -2.0, -1.0, -std::numeric_limits<double>::denorm_min(),
                                         0.0,  1e-320, 0.5,  1.0,  1.0 + 1e-15,
                                         2.0,  1e300,  inf};
  for (std::size_t i = 1; i < ascending.size(); ++i) CHECK(key_of(ascending[i - 1]) < key_of(ascending[i]));
  CHECK(key_of(-0.0) == key_of(0.0));
  CHECK(key_of(0, 5) < key_of(1, 0));
  CHECK(key_of(3, 4) < key_of(3, 5));
  CHECK(key_of(0, std::numeric_limits<Index>::max()) < key_of(1, 0));
}

TEST_CASE("order_by sorts as std::stable_sort does") {
  test::Random random(7);
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(random.below(40) - 20);
  std::vector<Index> expected(values.size());
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<Index>(i);
  std::stable_sort(expected.begin(), expected.end(), [&](Index a, Index b) { return values[a] < values[b]; });
  CHECK(order_by(static_cast<Index>(values.size()), [&](Index i) { return key_of(values[i]); }) == expected);
  for (double& value : values) value = random.number();
  std::stable_sort(expected.begin(), expected.end(), [&](Index a, Index b) { return values[a] < values[b]; });
  CHECK(order_by(static_cast<Index>(values.size()), [&](Index i) { return key_of(values[i]); }) == expected);
  CHECK(order_by(0, [](Index) { return std::uint64_t{0}; }).empty());
}

}  // namespace
}  // namespace pliant
