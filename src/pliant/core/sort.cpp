#include "pliant/core/sort.h"

#include <algorithm>
#include <cstring>

namespace pliant {

void sort_keyed(std::span<Keyed> items) { std::sort(items.begin(), items.end()); }

std::uint64_t key_of(double number) {
  // Bits of positive numbers ascend with them, those of negative ones descend.
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const double zero_is_positive = number + 0.0;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &zero_is_positive, sizeof bits);
  return bits & sign ? ~bits : bits | sign;
}

}  // namespace pliant
