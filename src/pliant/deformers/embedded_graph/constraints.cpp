#include "pliant/deformers/embedded_graph/constraints.h"

#include <algorithm>
#include <array>

#include "pliant/linalg/dense_kernels.h"

namespace pliant::embedded {
namespace {

/// Sums of w (v, 1)(v, 1)' over points v: the upper triangle, row by row.
using Moments = std::array<double, 10>;

Moments moments_of(const Eigen::Vector3d& v) {
  return {v[0] * v[0], v[0] * v[1], v[0] * v[2], v[0], v[1] * v[1],
          v[1] * v[2], v[1],        v[2] * v[2], v[2], 1.0};
}

void add_moments(const Moments& moments, double w, Moments& sum) {
  const dense::Vec2 scale = dense::splat2(w);
  for (int i = 0; i < 10; i += 2) {
    dense::store2(&sum[i], dense::load2(&sum[i]) + scale * dense::load2(&moments[i]));
  }
}

/// The same sums of (v - a, 1)(v - b, 1)'.
Eigen::Matrix4d moments_about(const Moments& sum, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b) {
  Eigen::Matrix4d m;
  for (int r = 0, i = 0; r < 4; ++r) {
    for (int c = r; c < 4; ++c) m(r, c) = m(c, r) = sum[i++];
  }
  for (int r = 0; r < 3; ++r) m.row(r) -= a[r] * m.row(3);
  for (int c = 0; c < 3; ++c) m.col(c) -= b[c] * m.col(3);
  return m;
}

/// y += block x.
void add_product(const Eigen::Matrix4d& block, const double* x, double* y) {
  dense::Vec2 y01 = dense::load2(y), y23 = dense::load2(y + 2);
  const double* column = block.data();
  for (int c = 0; c < 4; ++c, column += 4) {
    const dense::Vec2 xc = dense::splat2(x[c]);
    y01 += dense::load2(column) * xc;
    y23 += dense::load2(column + 2) * xc;
  }
  dense::store2(y, y01);
  dense::store2(y + 2, y23);
}

}  // namespace

void GraphConstraints::set_up(const Points& points, const Influences& influences,
                              const Points& nodes, const std::vector<Index>& free_of_node,
                              Index free_nodes, const std::vector<Edge>& edges) {
  free_nodes_ = free_nodes;
  influences_.clear();
  influences_.reserve(influences.indices.size());
  start_.assign(1, 0);
  for (Index l = 0; l < points.cols(); ++l) {
    for (int s = 0; s < influences.k; ++s) {
      const std::size_t at = static_cast<std::size_t>(l) * influences.k + s;
      const Index node = influences.indices[at];
      const double w = influences.weights[at];
      if (free_of_node[node] < 0 || w == 0.0) continue;
      Influence influence{free_of_node[node], {}};
      influence.coefficients << w * (points.col(l) - nodes.col(node)), w;
      influences_.push_back(influence);
    }
    start_.push_back(influences_.size());
  }
  residuals_ = targets_ = Points::Zero(3, points.cols());
  gradient_ = along_ = rhs_ = Vector::Zero(3 * rows());
  Points free_positions(3, free_nodes);
  for (Index node = 0; node < nodes.cols(); ++node) {
    if (free_of_node[node] >= 0) free_positions.col(free_of_node[node]) = nodes.col(node);
  }
  gather_blocks(points, free_positions, edges);
}

void GraphConstraints::gather_blocks(const Points& points, const Points& free_positions,
                                     const std::vector<Edge>& edges) {
  std::vector<std::size_t> first_edge(free_nodes_ + 1, edges.size());
  for (std::size_t e = edges.size(); e-- > 0;) first_edge[edges[e][0]] = e;
  for (Index j = free_nodes_; j-- > 0;) first_edge[j] = std::min(first_edge[j], first_edge[j + 1]);
  std::vector<Moments> of_node(free_nodes_, Moments{}), of_edge(edges.size(), Moments{});
  for (Index l = 0; l < points.cols(); ++l) {
    const Moments moments = moments_of(points.col(l));
    for (std::size_t p = start_[l]; p < start_[l + 1]; ++p) {
      const Index one = influences_[p].node;
      const double w = influences_[p].coefficients[3];
      add_moments(moments, w * w, of_node[one]);
      for (std::size_t q = start_[l]; q < p; ++q) {
        const Index two = influences_[q].node;
        std::size_t e = first_edge[std::min(one, two)];
        while (edges[e][1] != std::max(one, two)) ++e;
        add_moments(moments, w * influences_[q].coefficients[3], of_edge[e]);
      }
    }
  }
  blocks_.clear();
  auto add_block = [&](Index j, Index k, Index edge, const Moments& sum) {
    if (sum.back() == 0.0) return;
    const Eigen::Matrix4d block = moments_about(sum, free_positions.col(k), free_positions.col(j));
    blocks_.push_back({j, k, edge, block, block.transpose()});
  };
  for (Index j = 0; j < free_nodes_; ++j) add_block(j, j, -1, of_node[j]);
  for (std::size_t e = 0; e < edges.size(); ++e)
    add_block(edges[e][0], edges[e][1], static_cast<Index>(e), of_edge[e]);
}

void GraphConstraints::set_targets(const Points& displacements) {
  targets_ = displacements;
  transposed(targets_, rhs_);
}

void GraphConstraints::transposed(const Points& values, Vector& product) const {
  product.setZero();
  for (Index l = 0; l < values.cols(); ++l) {
    for (std::size_t i = start_[l]; i < start_[l + 1]; ++i) {
      const double* w = influences_[i].coefficients.data();
      const dense::Vec2 w01 = dense::load2(w), w23 = dense::load2(w + 2);
      double* n = product.data() + 4 * influences_[i].node;
      for (int a = 0; a < 3; ++a, n += rows()) {
        const dense::Vec2 value = dense::splat2(values(a, l));
        dense::store2(n, dense::load2(n) + value * w01);
        dense::store2(n + 2, dense::load2(n + 2) + value * w23);
      }
    }
  }
}

Eigen::Vector3d GraphConstraints::residual(const Vector& x, Index l) const {
  // Eq. 2 in displacements: sum of w_j (U_j (v - g_j) + t_j).
  Eigen::Vector3d r = -targets_.col(l);
  for (std::size_t i = start_[l]; i < start_[l + 1]; ++i) {
    const double* w = influences_[i].coefficients.data();
    const dense::Vec2 w01 = dense::load2(w), w23 = dense::load2(w + 2);
    const double* n = x.data() + 4 * influences_[i].node;
    for (int a = 0; a < 3; ++a, n += rows()) {
      const dense::Vec2 sum = w01 * dense::load2(n) + w23 * dense::load2(n + 2);
      r[a] += sum[0] + sum[1];
    }
  }
  return r;
}

Points GraphConstraints::residuals(const Vector& x) const {
  Points result(3, targets_.cols());
  for (Index l = 0; l < result.cols(); ++l) result.col(l) = residual(x, l);
  return result;
}

void GraphConstraints::apply_blocks(const Vector& d, Vector& product) const {
  product.setZero();
  for (int a = 0; a < 3; ++a) {
    const double* from = d.data() + a * rows();
    double* to = product.data() + a * rows();
    for (const Block& b : blocks_) {
      add_product(b.block, from + 4 * b.j, to + 4 * b.k);
      if (b.k != b.j) add_product(b.transposed, from + 4 * b.k, to + 4 * b.j);
    }
  }
}

void GraphConstraints::add_to(BlockMatrix& matrix, double w) const {
  for (const Block& b : blocks_) {
    double* block = b.edge < 0 ? matrix.diagonal_block(b.j) : matrix.edge_block(b.edge);
    Eigen::Map<Eigen::Matrix4d>(block) += w * b.block;
  }
}

double GraphConstraints::evaluate(const Vector& x) {
  for (Index l = 0; l < residuals_.cols(); ++l) residuals_.col(l) = residual(x, l);
  apply_blocks(x, gradient_);
  gradient_ -= rhs_;
  return residuals_.squaredNorm();
}

GraphConstraints::Course GraphConstraints::along(const Vector& d) {
  apply_blocks(d, along_);
  return {2.0 * d.dot(gradient_), d.dot(along_)};
}

}  // namespace pliant::embedded
