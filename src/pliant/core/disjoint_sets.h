// Which elements hang together: union-find.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Elements 0 .. n - 1, each a set of its own until joined. A set is known by its smallest element.
class DisjointSets {
 public:
  explicit DisjointSets(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The smallest element of the set of `element`.
  Index find(Index element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  void join(Index a, Index b) {
    if (parent_[a] == parent_[b]) return;  // over a mesh most joins tell nothing new
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  /// The smallest element of the set of each element.
  std::vector<Index> roots() {
    // Parents come before their children.
    for (Index& parent : parent_) parent = parent_[parent];
    return parent_;
  }

  /// Sets numbered 0 .. in order of their smallest elements.
  struct Numbered {
    Index count = 0;
    std::vector<Index> of;  ///< of each element
  };
  Numbered numbered() {
    Numbered sets{0, roots()};
    for (std::size_t i = 0; i < sets.of.size(); ++i) {
      const auto root = static_cast<std::size_t>(sets.of[i]);
      sets.of[i] = root == i ? sets.count++ : sets.of[root];
    }
    return sets;
  }

 private:
  std::vector<Index> parent_;  ///< never larger than the element
};

}  // namespace pliant
