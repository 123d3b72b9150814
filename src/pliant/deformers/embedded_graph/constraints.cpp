#include "pliant/deformers/embedded_graph/constraints.h"

#include <algorithm>
#include <array>

#include "pliant/linalg/dense_kernels.h"

namespace pliant::embedded {
namespace {

/// Sums of w (v, 1)(v, 1)' over points v: the upper triangle, row by row.
using Moments = std::array<double, 10>;

Moments moments_of(const Eigen::Vector3d& v) {
  return {v[0] * v[0], v[0] * v[1], v[0] * v[2], v[0], v[1] * v[1], v[1] * v[2], v[1], v[2] * v[2], v[2], 1.0};
}

void add_moments(const Moments& moments, double w, Moments& sum) {
  const dense::Vec2 scale = dense::splat2(w);
  for (int i = 0; i < 10; i += 2) {
    dense::store2(&sum[i], dense::load2(&sum[i]) + scale * dense::load2(&moments[i]));
  }
}

/// The same sums of (v - a, 1)(v - b, 1)'.
Eigen::Matrix4d moments_about(const Moments& sum, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
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

void GraphConstraints::set_up(const Points& points, const Influences& influences, const Points& nodes,
                              const std::vector<Index>& free_of_node, Index free_nodes,
                              const std::vector<Edge>& edges) {
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
  gradient_ = along_ = by_node_ = sum_by_node_ = Vector::Zero(3 * rows());
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
  auto edge_between = [&](Index j, Index k) {
    std::size_t e = first_edge[std::min(j, k)];
    while (edges[e][1] != std::max(j, k)) ++e;
    return e;
  };
  std::vector<Moments> of_node(free_nodes_, Moments{}), of_edge(edges.size(), Moments{});
  std::vector<Index> nodes, previous_nodes;
  std::vector<std::size_t> pairs;  // edges between the nodes of a point, which often has the last
                                   // one's nodes
  for (Index l = 0; l < points.cols(); ++l) {
    const Influence* const first = influences_.data() + start_[l];
    const std::size_t count = start_[l + 1] - start_[l];
    nodes.clear();
    for (std::size_t q = 0; q < count; ++q) nodes.push_back(first[q].node);
    if (nodes != previous_nodes) {
      pairs.clear();
      for (std::size_t q = 1; q < count; ++q) {
        for (std::size_t p = 0; p < q; ++p) pairs.push_back(edge_between(nodes[p], nodes[q]));
      }
      previous_nodes = nodes;
    }
    const Moments moments = moments_of(points.col(l));
    auto pair = pairs.begin();
    for (std::size_t q = 0; q < count; ++q) {
      const double w = first[q].coefficients[3];
      add_moments(moments, w * w, of_node[nodes[q]]);
      for (std::size_t p = 0; p < q; ++p) add_moments(moments, w * first[p].coefficients[3], of_edge[*pair++]);
    }
  }
  blocks_.clear();
  auto add_block = [&](Index j, Index k, Index edge, const Moments& sum) {
    if (sum.back() == 0.0) return;
    const Eigen::Matrix4d block = moments_about(sum, free_positions.col(k), free_positions.col(j));
    blocks_.push_back({j, k, edge, block, block.transpose()});
  };
  for (Index j = 0; j < free_nodes_; ++j) add_block(j, j, -1, of_node[j]);
  for (std::size_t e = 0; e < edges.size(); ++e) add_block(edges[e][0], edges[e][1], static_cast<Index>(e), of_edge[e]);
}

void GraphConstraints::add_common(const std::vector<Index>& points, const Eigen::Vector3d& value,
                                  Vector& product) const {
  std::vector<double> sums(static_cast<std::size_t>(rows()), 0.0);  // of coefficients
  for (Index l : points) {
    for (std::size_t i = start_[l]; i < start_[l + 1]; ++i)
      dense::add(influences_[i].coefficients.data(), 4, sums.data() + 4 * influences_[i].node);
  }
  for (int a = 0; a < 3; ++a) {
    for (Index r = 0; r < rows(); ++r) product[a * rows() + r] += value[a] * sums[r];
  }
}

Points GraphConstraints::residuals(const Vector& x) const {
  // Eq. 2 in displacements: sum of w_j (U_j (v - g_j) + t_j).
  Points result = -targets_;
  for (Index l = 0; l < result.cols(); ++l) {
    for (std::size_t i = start_[l]; i < start_[l + 1]; ++i) {
      for (int a = 0; a < 3; ++a) {
        result(a, l) += influences_[i].coefficients.dot(
            Eigen::Map<const Eigen::Vector4d>(x.data() + a * rows() + 4 * influences_[i].node));
      }
    }
  }
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
  // One pass over the constraints, on unknowns and sums node by node: (row a of U_j, t_j[a]) for
  // a = 0, 1, 2.
  for (Index j = 0; j < free_nodes_; ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) by_node_[12 * j + 4 * a + c] = x[a * rows() + 4 * j + c];
    }
  }
  sum_by_node_.setZero();
  dense::Vec2 squares = {};
  for (Index l = 0; l < residuals_.cols(); ++l) {
    dense::Vec2 sum[3] = {};
    for (std::size_t i = start_[l]; i < start_[l + 1]; ++i) {
      const double* n = by_node_.data() + 12 * influences_[i].node;
      const double* w = influences_[i].coefficients.data();
      const dense::Vec2 w01 = dense::load2(w), w23 = dense::load2(w + 2);
      for (int a = 0; a < 3; ++a) sum[a] += w01 * dense::load2(n + 4 * a) + w23 * dense::load2(n + 4 * a + 2);
    }
    double* r = residuals_.data() + 3 * l;
    for (int a = 0; a < 3; ++a) {
      r[a] = sum[a][0] + sum[a][1] - targets_(a, l);
      sum[a] = dense::splat2(r[a]);
      squares += sum[a] * sum[a];
    }
    for (std::size_t i = start_[l]; i < start_[l + 1]; ++i) {
      double* n = sum_by_node_.data() + 12 * influences_[i].node;
      const double* w = influences_[i].coefficients.data();
      const dense::Vec2 w01 = dense::load2(w), w23 = dense::load2(w + 2);
      for (int a = 0; a < 3; ++a, n += 4) {
        dense::store2(n, dense::load2(n) + sum[a] * w01);
        dense::store2(n + 2, dense::load2(n + 2) + sum[a] * w23);
      }
    }
  }
  for (Index j = 0; j < free_nodes_; ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 4; ++c) gradient_[a * rows() + 4 * j + c] = sum_by_node_[12 * j + 4 * a + c];
    }
  }
  return squares[0];
}

GraphConstraints::Course GraphConstraints::along(const Vector& d) {
  apply_blocks(d, along_);
  return {2.0 * dense::dot(d.data(), gradient_.data(), d.size()), dense::dot(d.data(), along_.data(), d.size())};
}

}  // namespace pliant::embedded
