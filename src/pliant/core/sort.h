// One sort for every list that is ordered by a number: each further type of element that std::sort or
// std::stable_sort is given costs 1 to 6 kB of WASM.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

struct Keyed {
  std::uint64_t key = 0;
  Index index = 0;
};

/// Ascending by key, equal keys in the order they had. In linear time.
void sort_keyed(std::span<Keyed> items);

/// Keys in the order of the numbers (not NaN); 0 and -0 have the same one.
std::uint64_t key_of(double number);
/// Keys in the order of the pairs; both ids at least 0.
inline std::uint64_t key_of(Index first, Index second) {
  return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(second);
}

/// 0 .. count - 1 sorted by key(i), equal keys in ascending order: as std::stable_sort has it.
template <class Key>
std::vector<Index> order_by(Index count, Key&& key) {
  std::vector<Keyed> items;
  items.reserve(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) items.push_back({key(i), i});
  sort_keyed(items);
  std::vector<Index> order;
  order.reserve(items.size());
  for (const Keyed& item : items) order.push_back(item.index);
  return order;
}

/// The items sorted by key(item), equal keys in the order they had.
template <class Item, class Key>
std::vector<Item> sorted_by(const std::vector<Item>& items, Key&& key) {
  std::vector<Item> sorted;
  sorted.reserve(items.size());
  const auto key_at = [&](Index i) { return key(items[i]); };
  for (const Index i : order_by(static_cast<Index>(items.size()), key_at)) {
    sorted.push_back(items[i]);
  }
  return sorted;
}

}  // namespace pliant
