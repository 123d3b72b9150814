#include "pliant/linalg/elimination.h"

#include <algorithm>

namespace pliant::elimination {

Adjacency adjacency_in_order(const BlockMatrix& matrix, const std::vector<Index>& position) {
  Adjacency adjacency(matrix.nodes);
  for (const auto& [j, k] : matrix.edges) {
    adjacency[position[j]].push_back(position[k]);
    adjacency[position[k]].push_back(position[j]);
  }
  return adjacency;
}

std::vector<Index> elimination_tree(const Adjacency& adjacency) {
  const Index n = static_cast<Index>(adjacency.size());
  std::vector<Index> parent(n, -1), ancestor(n, -1);
  for (Index k = 0; k < n; ++k) {
    for (Index i : adjacency[k]) {
      while (i != -1 && i < k) {
        const Index next = ancestor[i];
        ancestor[i] = k;
        if (next == -1) parent[i] = k;
        i = next;
      }
    }
  }
  return parent;
}

std::vector<Index> postorder(const std::vector<Index>& parent) {
  const Index n = static_cast<Index>(parent.size());
  std::vector<Index> head(n, -1), next(n, -1), order, stack;
  order.reserve(n);
  for (Index j = n - 1; j >= 0; --j) {
    if (parent[j] == -1) continue;
    next[j] = head[parent[j]];
    head[parent[j]] = j;
  }
  for (Index root = 0; root < n; ++root) {
    if (parent[root] != -1) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const Index j = stack.back();
      const Index child = head[j];
      if (child == -1) {
        order.push_back(j);
        stack.pop_back();
      } else {
        head[j] = next[child];
        stack.push_back(child);
      }
    }
  }
  return order;
}

Adjacency column_structure(const Adjacency& adjacency, const std::vector<Index>& parent) {
  const Index n = static_cast<Index>(adjacency.size());
  Adjacency structure(n), children(n);
  std::vector<Index> mark(n, -1);
  for (Index j = 0; j < n; ++j) {
    auto& rows = structure[j];
    mark[j] = j;
    auto take = [&](Index i) {
      if (i > j && mark[i] != j) {
        mark[i] = j;
        rows.push_back(i);
      }
    };
    for (Index i : adjacency[j]) take(i);
    for (Index child : children[j]) {
      for (Index i : structure[child]) take(i);
    }
    std::sort(rows.begin(), rows.end());
    if (parent[j] != -1) children[parent[j]].push_back(j);
  }
  return structure;
}

}  // namespace pliant::elimination
