#include "pliant/core/sort.h"

#include <algorithm>
#include <bit>

namespace pliant {

void sort_keyed(std::span<Keyed> items) { std::sort(items.begin(), items.end()); }

std::uint64_t key_of(double number) {
  // Bits of positive numbers ascend with them, those of negative ones descend.
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const auto bits = std::bit_cast<std::uint64_t>(number + 0.0);  // makes -0 into 0
  return bits & sign ? ~bits : bits | sign;
}

}  // namespace pliant
