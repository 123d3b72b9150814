#include "pliant/core/sort.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace pliant {
namespace {

constexpr std::size_t kFew = 64;  // below, counting bytes costs more than it saves
constexpr int kBytes = 8;

void sort_few(std::span<Keyed> items) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Keyed item = items[i];
    std::size_t place = i;
    for (; place > 0 && items[place - 1].key > item.key; --place) items[place] = items[place - 1];
    items[place] = item;
  }
}

std::size_t byte_of(std::uint64_t key, int byte) { return key >> (8 * byte) & 0xff; }

/// Byte by byte from the lowest; one that is the same in all keys takes no pass.
void sort_many(std::span<Keyed> items) {
  std::array<std::array<Index, 256>, kBytes> counts{};
  for (const Keyed& item : items) {
    for (int byte = 0; byte < kBytes; ++byte) ++counts[byte][byte_of(item.key, byte)];
  }
  std::vector<Keyed> other(items.size());
  std::span<Keyed> from = items, to = other;
  for (int byte = 0; byte < kBytes; ++byte) {
    std::array<Index, 256>& next = counts[byte];
    if (next[byte_of(items.front().key, byte)] == static_cast<Index>(items.size())) continue;
    Index begin = 0;
    for (Index& count : next) begin += std::exchange(count, begin);
    for (const Keyed& item : from) to[next[byte_of(item.key, byte)]++] = item;
    std::swap(from, to);
  }
  if (from.data() != items.data()) std::copy(from.begin(), from.end(), items.begin());
}

}  // namespace

void sort_keyed(std::span<Keyed> items) { items.size() < kFew ? sort_few(items) : sort_many(items); }

std::uint64_t key_of(double number) {
  // Bits of positive numbers ascend with them, those of negative ones descend.
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const double zero_is_positive = number + 0.0;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &zero_is_positive, sizeof bits);
  return bits & sign ? ~bits : bits | sign;
}

}  // namespace pliant
