#include "pliant/linalg/sparse_cholesky.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pliant/core/message.h"
#include "pliant/linalg/dense_kernels.h"
#include "pliant/linalg/elimination.h"
#include "pliant/linalg/ordering.h"
#include "pliant/linalg/substitution.h"

namespace pliant {

using namespace elimination;

namespace {

/// Whether a child supernode may be merged into its parent although that stores some zeros: small
/// fronts cost more in overhead than in arithmetic.
bool worth_merging(double width, double zeros, double total) {
  const double padding = zeros / total;
  return width <= 1 || (width <= 4 && padding < 0.4) || (width <= 16 && padding < 0.15) || padding < 0.05;
}

}  // namespace

void SparseCholesky::place_nodes(const BlockMatrix& matrix, const std::vector<Index>& order) {
  position_.assign(nodes_, 0);
  for (Index place = 0; place < nodes_; ++place) position_[order[place]] = place;
  const std::vector<Index> by_tree = postorder(elimination_tree(adjacency_in_order(matrix, position_)));
  for (Index place = 0; place < nodes_; ++place) position_[order[by_tree[place]]] = place;
}

void SparseCholesky::find_supernodes(const std::vector<std::vector<Index>>& structure,
                                     const std::vector<Index>& parent) {
  // Exact supernodes first, then bottom-up mergers of a supernode with the one that follows it.
  supernodes_.clear();
  std::vector<double> zeros;  // nodes-squared of explicit zeros in each panel
  for (Index j = 0; j < nodes_; ++j) {
    const bool continues = j > 0 && parent[j - 1] == j && structure[j - 1].size() == structure[j].size() + 1;
    if (continues) {
      ++supernodes_.back().width;
      supernodes_.back().rows = structure[j];
    } else {
      Supernode fresh;
      fresh.first = j;
      fresh.width = 1;
      fresh.rows = structure[j];
      supernodes_.push_back(std::move(fresh));
      zeros.push_back(0.0);
    }
    // The supernode that ends here may swallow the chain of last children before it.
    const bool ends = j + 1 == nodes_ || parent[j] != j + 1 || structure[j].size() != structure[j + 1].size() + 1;
    while (ends && supernodes_.size() > 1) {
      Supernode& top = supernodes_.back();
      Supernode& below = supernodes_[supernodes_.size() - 2];
      const bool is_child = !below.rows.empty() && below.rows.front() < top.first + top.width;
      if (!is_child) break;
      const double width = below.width + top.width;
      const double added = static_cast<double>(below.width) * (top.height() - static_cast<double>(below.rows.size()));
      const double all_zeros = zeros[zeros.size() - 2] + zeros.back() + added;
      const double total = width * (width + static_cast<double>(top.rows.size()));
      if (!worth_merging(width * block_ / 4.0, all_zeros, total)) break;
      below.width += top.width;
      below.rows = std::move(top.rows);
      supernodes_.pop_back();
      zeros.pop_back();
      zeros.back() = all_zeros;
    }
  }
}

void SparseCholesky::link_supernodes() {
  supernode_of_.assign(nodes_, 0);
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    for (Index j = 0; j < supernodes_[s].width; ++j) {
      supernode_of_[supernodes_[s].first + j] = static_cast<Index>(s);
    }
  }
  for (Supernode& node : supernodes_) node.children.clear();
  factor_size_ = 0;
  const std::size_t square = static_cast<std::size_t>(block_) * block_;
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    Supernode& node = supernodes_[s];
    node.factor = factor_size_;
    factor_size_ += square * node.height() * node.width;
    if (node.rows.empty()) continue;
    node.parent = supernode_of_[node.rows.front()];
    supernodes_[node.parent].children.push_back(static_cast<Index>(s));
    const Supernode& parent = supernodes_[node.parent];
    node.segments.clear();
    Index below = 0;
    for (Index from = 0; from < static_cast<Index>(node.rows.size()); ++from) {
      const Index row = node.rows[from];
      Index to = row - parent.first;
      if (to >= parent.width) {
        while (parent.rows[below] != row) ++below;
        to = parent.width + below;
      }
      if (!node.segments.empty() && node.segments.back().to + node.segments.back().count == to)
        ++node.segments.back().count;
      else
        node.segments.push_back({from, to, 1});
    }
  }
  for (auto node = supernodes_.rbegin(); node != supernodes_.rend(); ++node)
    node->side = node->parent < 0 ? 0 : 1 - supernodes_[node->parent].side;
}

void SparseCholesky::place_entries(const BlockMatrix& matrix) {
  edges_ = matrix.edges.size();
  entries_.assign(supernodes_.size(), {});
  auto front_row = [&](const Supernode& node, Index place) {
    if (place < node.first + node.width) return place - node.first;
    const auto found = std::lower_bound(node.rows.begin(), node.rows.end(), place);
    return node.width + static_cast<Index>(found - node.rows.begin());
  };
  for (Index j = 0; j < nodes_; ++j) {
    const Index s = supernode_of_[position_[j]];
    const Index at = position_[j] - supernodes_[s].first;
    entries_[s].push_back({-1 - j, at, at, false});
  }
  for (std::size_t e = 0; e < matrix.edges.size(); ++e) {
    const Index column_place = position_[matrix.edges[e][0]], row_place = position_[matrix.edges[e][1]];
    const bool transposed = row_place < column_place;
    const Index low = std::min(row_place, column_place), high = std::max(row_place, column_place);
    const Index s = supernode_of_[low];
    entries_[s].push_back(
        {static_cast<Index>(e), front_row(supernodes_[s], high), low - supernodes_[s].first, transposed});
  }
}

std::array<std::size_t, 2> SparseCholesky::stack_sizes() const {
  // Replays the factorisation, where a front's update matrix replaces those of its children, which
  // lie on top of the other stack.
  std::array<std::size_t, 2> used{}, most{};
  std::vector<std::size_t> from_children(supernodes_.size(), 0);
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    const Supernode& node = supernodes_[s];
    const std::size_t size = update_size(node);
    used[node.side] += size;
    most[node.side] = std::max(most[node.side], used[node.side]);
    used[1 - node.side] -= from_children[s];
    if (node.parent >= 0) from_children[node.parent] += size;
  }
  return most;
}

Status SparseCholesky::analyze(const BlockMatrix& matrix) {
  return analyze(matrix, fill_reducing_order(matrix.nodes, matrix.edges));
}

Status SparseCholesky::analyze(const BlockMatrix& matrix, const std::vector<Index>& order) {
  assert(static_cast<Index>(order.size()) == matrix.nodes);
  block_ = matrix.block;
  nodes_ = matrix.nodes;
  place_nodes(matrix, order);
  const Adjacency adjacency = adjacency_in_order(matrix, position_);
  const std::vector<Index> parent = elimination_tree(adjacency);
  find_supernodes(column_structure(adjacency, parent), parent);
  return prepare(matrix);
}

Status SparseCholesky::analyze_like(const SparseCholesky& other, const BlockMatrix& matrix) {
  assert(matrix.nodes == other.nodes_);
  block_ = matrix.block;
  nodes_ = matrix.nodes;
  position_ = other.position_;
  supernodes_ = other.supernodes_;
  return prepare(matrix);
}

Status SparseCholesky::prepare(const BlockMatrix& matrix) {
  link_supernodes();
  const std::array<std::size_t, 2> stacks = stack_sizes();
  const std::size_t bytes = (factor_size_ + stacks[0] + stacks[1]) * sizeof(double);
  if (bytes > kMaxBytes) {
    return {ErrorCode::too_large, message({"the system of ", rows(), " unknowns needs a factor of ", bytes >> 20,
                                           " MiB; expected at most ", kMaxBytes >> 20})};
  }
  place_entries(matrix);
  panels_.clear();
  below_.clear();
  for (const Supernode& node : supernodes_) {
    panels_.push_back({node.factor, node.first, node.width, static_cast<Index>(node.rows.size())});
    below_.insert(below_.end(), node.rows.begin(), node.rows.end());
  }
  std::size_t tallest = 0;
  for (const Supernode& node : supernodes_) {
    tallest = std::max(tallest, static_cast<std::size_t>(node.height()) * block_);
  }
  exact_.factor.reset(new double[factor_size_]);
  rough_.factor.reset();
  for (int side : {0, 1}) stacks_[side].reset(new double[stacks[side]]);
  packed_.resize(dense::packed_size(tallest));
  exact_.below.resize(dense::Three::stride * tallest);
  exact_.gathered.assign(static_cast<std::size_t>(rows()) * dense::Three::stride, 0.0);
  return {};
}

void SparseCholesky::assemble(const BlockMatrix& matrix, std::size_t s, double* panel) const {
  const std::ptrdiff_t ld = static_cast<std::ptrdiff_t>(supernodes_[s].height()) * block_;
  const int b = block_;
  for (const Entry& entry : entries_[s]) {
    const double* source =
        entry.source < 0 ? matrix.diagonal_block(-1 - entry.source) : matrix.edge_block(entry.source);
    double* target = panel + entry.column * b * ld + entry.row * b;
    for (int c = 0; c < b; ++c) {
      if (!entry.transposed) {
        dense::add(source + c * b, b, target + c * ld);
        continue;
      }
      for (int r = 0; r < b; ++r) target[c * ld + r] += source[r * b + c];
    }
  }
}

void SparseCholesky::extend_add(const Supernode& child, const double* source, double* target, std::ptrdiff_t ld,
                                Index first, Index last) const {
  const std::ptrdiff_t b = block_, n = static_cast<std::ptrdiff_t>(child.rows.size()) * b;
  for (std::size_t s = 0; s < child.segments.size(); ++s) {
    const Segment& across = child.segments[s];
    const Index begin = std::max(across.to, first), end = std::min(across.to + across.count, last);
    for (std::ptrdiff_t column = begin * b; column < end * b; ++column) {
      const std::ptrdiff_t c = column - across.to * b;
      double* to = target + (column - first * b) * ld - first * b;
      const double* from = source + (across.from * b + c) * n;
      // The lower triangle, from the block on the diagonal on.
      const std::ptrdiff_t skipped = c / b * b;
      dense::add(from + across.from * b + skipped, across.count * b - skipped, to + across.to * b + skipped);
      for (std::size_t down = s + 1; down < child.segments.size(); ++down) {
        const Segment& rows = child.segments[down];
        dense::add(from + rows.from * b, rows.count * b, to + rows.to * b);
      }
    }
  }
}

Status SparseCholesky::factorize(const BlockMatrix& matrix) {
  assert(matrix.nodes == nodes_ && matrix.block == block_ && matrix.edges.size() == edges_);
  const int b = block_;
  rough_.factor.reset();  // belongs to the last values
  // The update matrices that wait for their parents lie on two stacks, those of the next front's
  // children on top of one: its own goes to the other.
  std::array<std::size_t, 2> top{};
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    const Supernode& node = supernodes_[s];
    const int columns = node.width * b, height = node.height() * b, below = height - columns;
    double* panel = exact_.factor.get() + node.factor;
    double* update = stacks_[node.side].get() + top[node.side];
    std::size_t& children_top = top[1 - node.side];
    for (Index child : node.children) children_top -= update_size(supernodes_[child]);
    // Adds what the children leave to a part of this front: its panel, or its update matrix.
    auto add_children = [&](double* target, std::ptrdiff_t ld, Index first, Index last) {
      const double* source = stacks_[1 - node.side].get() + children_top;
      for (Index child : node.children) {
        extend_add(supernodes_[child], source, target, ld, first, last);
        source += update_size(supernodes_[child]);
      }
    };

    std::fill_n(panel, static_cast<std::ptrdiff_t>(height) * columns, 0.0);
    assemble(matrix, s, panel);
    add_children(panel, height, 0, node.width);
    if (!dense::factorize_panel(panel, height, height, columns, packed_.data())) {
      return {ErrorCode::not_solvable, "the system matrix is not positive definite; expected enough constraints"};
    }
    if (below == 0) continue;
    dense::minus_outer(update, below, panel + columns, height, below, columns, packed_.data());
    add_children(update, below, node.width, node.height());
    top[node.side] += update_size(node);
  }
  return {};
}

/// std::copy_n for a few numbers: a call of memmove would take longer than they do.
template <class Scalar>
inline Scalar* copy_block(const Scalar* from, std::size_t n, Scalar* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = from[i];
  return to + n;
}

void SparseCholesky::allow_rough() {
  // Diagonals hold inverse pivots. Their spread bounds the condition of the matrix from below, and
  // for the matrices of surfaces it follows it closely.
  constexpr double kMostSpread = 300.0;
  rough_.factor.reset();
  if (block_ != 1) return;
  double least = 1e12, most = 1e-12;
  for (const Panel& panel : panels_) {
    const std::size_t height = static_cast<std::size_t>(panel.width + panel.rows) * block_;
    for (std::size_t j = 0; j < static_cast<std::size_t>(panel.width) * block_; ++j) {
      const double pivot = exact_.factor[panel.factor + j * height + j];
      least = std::min(least, pivot);
      most = std::max(most, pivot);
    }
  }
  if (!(most <= kMostSpread * least)) return;
  rough_.factor.reset(new float[factor_size_]);
  std::copy_n(exact_.factor.get(), factor_size_, rough_.factor.get());
  rough_.gathered.assign(exact_.gathered.size(), 0.0f);
  rough_.below.resize(exact_.below.size());
}

template <class Lanes, int Block>
void SparseCholesky::solve_some(double* x, Workspace<typename Lanes::Scalar>& workspace, double scale) {
  using Scalar = typename Lanes::Scalar;
  constexpr std::size_t stride = Lanes::stride;
  const std::size_t n = static_cast<std::size_t>(rows()), b = Block > 0 ? Block : block_;
  const Scalar* factor = workspace.factor.get();
  Scalar* z = workspace.gathered.data();
  Scalar* below = workspace.below.data();
  for (Index j = 0; j < nodes_; ++j) {
    const double* from = x + j * b;
    Scalar* to = z + position_[j] * b * stride;
    for (std::size_t r = 0; r < b; ++r) {
      for (int c = 0; c < Lanes::columns; ++c) to[r * stride + c] = static_cast<Scalar>(scale * from[c * n + r]);
    }
  }
  const Index* row = below_.data();
  for (const Panel& panel : panels_) {
    dense::forward_panel<Lanes>(factor + panel.factor, static_cast<int>((panel.width + panel.rows) * b),
                                static_cast<int>(panel.width * b), z + panel.first * b * stride, below);
    const Scalar* from = below;
    for (Index i = 0; i < panel.rows; ++i, ++row) {
      Scalar* to = z + *row * b * stride;
      for (std::size_t r = 0; r < b; ++r, from += stride, to += stride) {
        Lanes value = Lanes::load(to);
        value.subtract(Lanes::load(from));
        value.store(to);
      }
    }
  }
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    row -= panel->rows;
    Scalar* to = below;
    for (Index i = 0; i < panel->rows; ++i) to = copy_block(z + row[i] * b * stride, b * stride, to);
    dense::backward_panel<Lanes>(factor + panel->factor, static_cast<int>((panel->width + panel->rows) * b),
                                 static_cast<int>(panel->width * b), z + panel->first * b * stride, below);
  }
  const double unscale = 1.0 / scale;
  for (Index j = 0; j < nodes_; ++j) {
    const Scalar* from = z + position_[j] * b * stride;
    double* to = x + j * b;
    for (std::size_t r = 0; r < b; ++r) {
      for (int c = 0; c < Lanes::columns; ++c) to[c * n + r] = unscale * from[r * stride + c];
    }
  }
}

void SparseCholesky::solve(double* x, int columns) {
  const std::size_t n = static_cast<std::size_t>(rows());
  int c = 0;
  for (; c + 3 <= columns; c += 3) {
    if (block_ == 1) {
      solve_some<dense::Three, 1>(x + c * n, exact_);
    } else if (block_ == 4) {
      solve_some<dense::Three, 4>(x + c * n, exact_);
    } else {
      solve_some<dense::Three, 0>(x + c * n, exact_);
    }
  }
  for (; c < columns; ++c) solve_some<dense::One, 0>(x + c * n, exact_);
}

void SparseCholesky::solve_roughly(double* x) {
  if (rough_.factor == nullptr) return solve(x, 3);
  double largest = 0.0;
  for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(rows()); ++i) largest = std::max(largest, std::abs(x[i]));
  // Single precision ends at 1e-38; gradients go below.
  if (largest > 0.0) solve_some<dense::RoughThree, 1>(x, rough_, 1.0 / largest);
}

}  // namespace pliant
