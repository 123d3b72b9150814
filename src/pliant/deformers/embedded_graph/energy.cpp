#include "pliant/deformers/embedded_graph/energy.h"

#include <algorithm>
#include <cmath>

#include "pliant/linalg/dense_kernels.h"

namespace pliant::embedded {
namespace {

/// The six conditions of eq. 5 on R = I + U: c1.c2, c1.c3, c2.c3, and c_i.c_i - 1.
using Conditions = std::array<double, 6>;
constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {1, 2}, {0, 0}, {1, 1}, {2, 2}};

/// In displacements, so that conditions near rest keep their digits.
Conditions conditions(const Eigen::Matrix3d& u) {
  Conditions f;
  for (int q = 0; q < 6; ++q) {
    const auto [a, b] = kPairs[q];
    f[q] = u(a, b) + u(b, a) + u.col(a).dot(u.col(b));
  }
  return f;
}

/// Derivatives of the conditions at R along D.
Conditions conditions_along(const Eigen::Matrix3d& r, const Eigen::Matrix3d& d) {
  Conditions f;
  for (int q = 0; q < 6; ++q) {
    const auto [a, b] = kPairs[q];
    f[q] = r.col(a).dot(d.col(b)) + r.col(b).dot(d.col(a));
  }
  return f;
}

/// Their second-order part along D.
Conditions conditions_across(const Eigen::Matrix3d& d) {
  Conditions f;
  for (int q = 0; q < 6; ++q) f[q] = d.col(kPairs[q][0]).dot(d.col(kPairs[q][1]));
  return f;
}

void add_outer(double* block, const Eigen::Vector4d& rows, const Eigen::Vector4d& columns,
               double w = 1.0) {
  const dense::Vec2 r01 = dense::load2(rows.data()), r23 = dense::load2(rows.data() + 2);
  for (int c = 0; c < 4; ++c, block += 4) {
    const dense::Vec2 scale = dense::splat2(w * columns[c]);
    dense::store2(block, dense::load2(block) + r01 * scale);
    dense::store2(block + 2, dense::load2(block + 2) + r23 * scale);
  }
}

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

double Quartic::first_minimum() const {
  // Newton on the derivative from the left, safeguarded by a bracket. The derivative starts below
  // zero and its leading coefficient is not negative, so it crosses zero unless the course is flat.
  auto slope = [&](double a) { return c[1] + a * (2 * c[2] + a * (3 * c[3] + a * 4 * c[4])); };
  auto curvature = [&](double a) { return 2 * c[2] + a * (6 * c[3] + a * 12 * c[4]); };
  if (!(c[1] < 0.0)) return 0.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; slope(high) < 0.0; ++i) {
    if (i == 60) return 0.0;
    low = high;
    high *= 2.0;
  }
  double alpha = high;
  for (int i = 0; i < 100 && high - low > 1e-14 * high; ++i) {
    const double s = slope(alpha);
    (s < 0.0 ? low : high) = alpha;
    const double curved = curvature(alpha);
    const double newton = curved > 0.0 ? alpha - s / curved : low;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == alpha) break;
    alpha = next;
  }
  return alpha;
}

void GraphEnergy::set_up(const DeformationGraph& graph, const std::vector<bool>& frozen,
                         const Points& constrained, const Influences& influences,
                         const Weights& weights) {
  weights_ = weights;
  all_nodes_ = graph.size();
  const Points g = graph.scaled(graph.nodes);
  std::vector<Index> free_of_node(graph.size(), -1);
  node_of_free_.clear();
  for (Index j = 0; j < graph.size(); ++j) {
    if (frozen[j]) continue;
    free_of_node[j] = free_nodes();
    node_of_free_.push_back(j);
  }

  edges_.clear();
  free_edges_.clear();
  free_edge_index_.clear();
  for (const auto& [j, k] : graph.edges) {
    if (frozen[j] && frozen[k]) continue;  // at rest on both ends: no energy
    edges_.push_back({free_of_node[j], free_of_node[k], g.col(k) - g.col(j)});
    const bool is_free = !frozen[j] && !frozen[k];
    free_edge_index_.push_back(is_free ? static_cast<Index>(free_edges_.size()) : -1);
    if (is_free) free_edges_.push_back({free_of_node[j], free_of_node[k]});
  }

  influences_.clear();
  influences_.reserve(influences.indices.size());
  constraint_start_.assign(1, 0);
  for (Index l = 0; l < constrained.cols(); ++l) {
    for (int s = 0; s < influences.k; ++s) {
      const std::size_t at = static_cast<std::size_t>(l) * influences.k + s;
      const Index node = influences.indices[at];
      const double w = influences.weights[at];
      if (frozen[node] || w == 0.0) continue;
      Influence influence{free_of_node[node], {}};
      influence.coefficients << w * (constrained.col(l) - g.col(node)), w;
      influences_.push_back(influence);
    }
    constraint_start_.push_back(influences_.size());
  }
  targets_ = Points::Zero(3, constrained.cols());
  con_ = targets_;
  reg_.resize(3, 2 * static_cast<Index>(edges_.size()));
  reg_along_.resizeLike(reg_);
  con_rhs_.setZero(3 * rows());
  con_gradient_ = con_rhs_;
  con_along_.setZero(3 * rows());
  gather_constraint_blocks(constrained, g(Eigen::all, node_of_free_));
}

void GraphEnergy::gather_constraint_blocks(const Points& constrained, const Points& nodes) {
  std::vector<std::size_t> first_edge(free_nodes() + 1, free_edges_.size());
  for (std::size_t e = free_edges_.size(); e-- > 0;) first_edge[free_edges_[e][0]] = e;
  for (Index j = free_nodes(); j-- > 0;) first_edge[j] = std::min(first_edge[j], first_edge[j + 1]);
  std::vector<Moments> of_node(free_nodes(), Moments{}), of_edge(free_edges_.size(), Moments{});
  for (Index l = 0; l < constrained.cols(); ++l) {
    const Moments moments = moments_of(constrained.col(l));
    for (std::size_t p = constraint_start_[l]; p < constraint_start_[l + 1]; ++p) {
      const Index one = influences_[p].node;
      const double w = influences_[p].coefficients[3];
      add_moments(moments, w * w, of_node[one]);
      for (std::size_t q = constraint_start_[l]; q < p; ++q) {
        const Index two = influences_[q].node;
        std::size_t e = first_edge[std::min(one, two)];
        while (free_edges_[e][1] != std::max(one, two)) ++e;
        add_moments(moments, w * influences_[q].coefficients[3], of_edge[e]);
      }
    }
  }
  constraint_blocks_.clear();
  auto add_block = [&](Index j, Index k, const Moments& sum) {
    if (sum.back() == 0.0) return;
    const Eigen::Matrix4d block = moments_about(sum, nodes.col(k), nodes.col(j));
    constraint_blocks_.push_back({j, k, block, block.transpose()});
  };
  for (Index j = 0; j < free_nodes(); ++j) add_block(j, j, of_node[j]);
  for (std::size_t e = 0; e < free_edges_.size(); ++e)
    add_block(free_edges_[e][0], free_edges_[e][1], of_edge[e]);
}

void GraphEnergy::set_targets(const Points& displacements) {
  targets_ = displacements;
  constraint_rhs(targets_, con_rhs_);
}

void GraphEnergy::constraint_rhs(const Points& values, Vector& rhs) const {
  rhs.setZero();
  for (Index l = 0; l < values.cols(); ++l) {
    for (std::size_t i = constraint_start_[l]; i < constraint_start_[l + 1]; ++i) {
      const double* w = influences_[i].coefficients.data();
      const dense::Vec2 w01 = dense::load2(w), w23 = dense::load2(w + 2);
      double* n = rhs.data() + 4 * influences_[i].node;
      for (int a = 0; a < 3; ++a, n += rows()) {
        const dense::Vec2 value = dense::splat2(values(a, l));
        dense::store2(n, dense::load2(n) + value * w01);
        dense::store2(n + 2, dense::load2(n + 2) + value * w23);
      }
    }
  }
}

Eigen::Matrix3d GraphEnergy::displacement_gradient(const Vector& x, Index j) const {
  Eigen::Matrix3d u;
  for (int a = 0; a < 3; ++a) u.row(a) = Eigen::Map<const Eigen::RowVector3d>(entry(x, a, j));
  return u;
}

Eigen::Vector3d GraphEnergy::translation(const Vector& x, Index j) const {
  return {entry(x, 0, j)[3], entry(x, 1, j)[3], entry(x, 2, j)[3]};
}

void GraphEnergy::regularization_residuals(const Vector& x, Points& reg) const {
  // Eq. 7 in displacements: R_j (g_k - g_j) + g_j + t_j - g_k - t_k = U_j d + t_j - t_k.
  static constexpr double kAtRest[4] = {0, 0, 0, 0};
  for (int a = 0; a < 3; ++a) {
    const double* part = x.data() + a * rows();
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const FreeEdge& edge = edges_[e];
      const double* j = edge.j < 0 ? kAtRest : part + 4 * edge.j;
      const double* k = edge.k < 0 ? kAtRest : part + 4 * edge.k;
      const double shift = j[3] - k[3];
      reg(a, 2 * e) = j[0] * edge.d[0] + j[1] * edge.d[1] + j[2] * edge.d[2] + shift;
      reg(a, 2 * e + 1) = -(k[0] * edge.d[0] + k[1] * edge.d[1] + k[2] * edge.d[2]) - shift;
    }
  }
}

Eigen::Vector3d GraphEnergy::constraint_residual(const Vector& x, Index l) const {
  // Eq. 2 in displacements: sum of w_j (U_j (v - g_j) + t_j).
  Eigen::Vector3d r = -targets_.col(l);
  for (std::size_t i = constraint_start_[l]; i < constraint_start_[l + 1]; ++i) {
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

Points GraphEnergy::constraint_residuals(const Vector& x) const {
  Points residuals(3, targets_.cols());
  for (Index l = 0; l < residuals.cols(); ++l) residuals.col(l) = constraint_residual(x, l);
  return residuals;
}

void GraphEnergy::apply_constraint_blocks(const Vector& d, Vector& product) const {
  product.setZero();
  for (const ConstraintBlock& b : constraint_blocks_) {
    for (int a = 0; a < 3; ++a) {
      add_product(b.block, entry(d, a, b.j), entry(product, a, b.k));
      if (b.k != b.j) add_product(b.transposed, entry(d, a, b.k), entry(product, a, b.j));
    }
  }
}

double GraphEnergy::rotation_term(const Vector& x, Index j) const {
  double sum = 0.0;
  for (double f : conditions(displacement_gradient(x, j))) sum += f * f;
  return sum;
}

double GraphEnergy::rotation_terms(const Vector& x) const {
  double sum = 0.0;
  for (Index j = 0; j < free_nodes(); ++j) sum += rotation_term(x, j);
  return sum;
}

void GraphEnergy::evaluate(const Vector& x) {
  regularization_residuals(x, reg_);
  for (Index l = 0; l < con_.cols(); ++l) con_.col(l) = constraint_residual(x, l);
  apply_constraint_blocks(x, con_gradient_);
  con_gradient_ -= con_rhs_;
  terms_ = {rotation_terms(x), reg_.squaredNorm(), con_.squaredNorm()};
}

void GraphEnergy::advance(double alpha, const Vector& x) {
  const double constraint = terms_.constraint + alpha * (con_slope_ + alpha * con_curvature_);
  // What is left after such a fall is mostly rounding.
  if (!(constraint > 1e-4 * terms_.constraint)) return evaluate(x);
  reg_ += alpha * reg_along_;
  con_gradient_ += alpha * con_along_;
  terms_ = {rotation_terms(x), reg_.squaredNorm(), constraint};
}

void GraphEnergy::retreat(double alpha, const Terms& terms) {
  reg_ -= alpha * reg_along_;
  con_gradient_ -= alpha * con_along_;
  terms_ = terms;
}

void GraphEnergy::node_terms(const Vector& x, std::vector<double>& rotation,
                             std::vector<double>& regularization) const {
  rotation.assign(all_nodes_, 0.0);
  regularization.assign(all_nodes_, 0.0);
  for (Index j = 0; j < free_nodes(); ++j) rotation[node_of_free_[j]] = rotation_term(x, j);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [j, k, d] = edges_[e];
    if (j >= 0) regularization[node_of_free_[j]] += reg_.col(2 * e).squaredNorm();
    if (k >= 0) regularization[node_of_free_[k]] += reg_.col(2 * e + 1).squaredNorm();
  }
}

void GraphEnergy::half_gradient(const Vector& x, Vector& gradient) const {
  gradient = weights_.constraint * con_gradient_;
  for (int a = 0; a < 3; ++a) {
    double* part = gradient.data() + a * rows();
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const FreeEdge& edge = edges_[e];
      const double forth = weights_.regularization * reg_(a, 2 * e);
      const double back = weights_.regularization * reg_(a, 2 * e + 1);
      if (edge.j >= 0) {
        double* j = part + 4 * edge.j;
        for (int c = 0; c < 3; ++c) j[c] += forth * edge.d[c];
        j[3] += forth - back;
      }
      if (edge.k >= 0) {
        double* k = part + 4 * edge.k;
        for (int c = 0; c < 3; ++c) k[c] -= back * edge.d[c];
        k[3] += back - forth;
      }
    }
  }
  for (Index j = 0; j < free_nodes(); ++j) {
    const Eigen::Matrix3d u = displacement_gradient(x, j);
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + u;
    const Conditions f = conditions(u);
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();  // of half of Rot(R), by columns
    for (int q = 0; q < 6; ++q) {
      const auto [a, b] = kPairs[q];
      g.col(a) += f[q] * r.col(b);
      g.col(b) += f[q] * r.col(a);
    }
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) entry(gradient, a, j)[c] += weights_.rotation * g(a, c);
    }
  }
}

Quartic GraphEnergy::along(const Vector& x, const Vector& d) {
  regularization_residuals(d, reg_along_);
  apply_constraint_blocks(d, con_along_);
  con_slope_ = 2.0 * d.dot(con_gradient_);
  con_curvature_ = d.dot(con_along_);
  Quartic course;
  auto& c = course.c;
  c[0] = total();
  c[1] = 2.0 * weights_.regularization * reg_.cwiseProduct(reg_along_).sum() +
         weights_.constraint * con_slope_;
  c[2] = weights_.regularization * reg_along_.squaredNorm() + weights_.constraint * con_curvature_;
  for (Index j = 0; j < free_nodes(); ++j) {
    const Eigen::Matrix3d u = displacement_gradient(x, j), step = displacement_gradient(d, j);
    const Conditions f0 = conditions(u), f2 = conditions_across(step);
    const Conditions f1 = conditions_along(Eigen::Matrix3d::Identity() + u, step);
    for (int q = 0; q < 6; ++q) {
      c[1] += weights_.rotation * 2.0 * f0[q] * f1[q];
      c[2] += weights_.rotation * (f1[q] * f1[q] + 2.0 * f0[q] * f2[q]);
      c[3] += weights_.rotation * 2.0 * f1[q] * f2[q];
      c[4] += weights_.rotation * f2[q] * f2[q];
    }
  }
  return course;
}

void GraphEnergy::constant_matrix(BlockMatrix& matrix) const {
  matrix.set_zero(4, free_nodes(), free_edges_);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const FreeEdge& edge = edges_[e];
    const double w = weights_.regularization;
    // U_j d + t_j - t_k and -U_k d + t_k - t_j.
    Eigen::Vector4d jj, kk;
    const Eigen::Vector4d shift(0, 0, 0, -1);
    jj << edge.d, 1.0;
    kk << -edge.d, 1.0;
    if (edge.j >= 0) {
      add_outer(matrix.diagonal_block(edge.j), jj, jj, w);
      add_outer(matrix.diagonal_block(edge.j), shift, shift, w);
    }
    if (edge.k >= 0) {
      add_outer(matrix.diagonal_block(edge.k), kk, kk, w);
      add_outer(matrix.diagonal_block(edge.k), shift, shift, w);
    }
    if (free_edge_index_[e] >= 0) {
      add_outer(matrix.edge_block(free_edge_index_[e]), shift, jj, w);
      add_outer(matrix.edge_block(free_edge_index_[e]), kk, shift, w);
    }
  }
  for (const ConstraintBlock& b : constraint_blocks_) {
    const auto edge = std::lower_bound(free_edges_.begin(), free_edges_.end(), Edge{b.j, b.k});
    double* block =
        b.j == b.k ? matrix.diagonal_block(b.j) : matrix.edge_block(edge - free_edges_.begin());
    Eigen::Map<Eigen::Matrix4d>(block) += weights_.constraint * b.block;
  }
}

void GraphEnergy::gauss_newton_matrix(const Vector& x, const BlockMatrix& constant,
                                      BlockMatrix& matrix) const {
  if (matrix.block != 12 || matrix.nodes != free_nodes())
    matrix.set_zero(12, free_nodes(), free_edges_);
  using Block = Eigen::Matrix<double, 12, 12>;
  auto expand = [](const double* from, double* to) {
    Eigen::Map<Block> block(to);
    block.setZero();
    for (int a = 0; a < 3; ++a)
      block.block<4, 4>(4 * a, 4 * a) = Eigen::Map<const Eigen::Matrix4d>(from);
  };
  for (std::size_t e = 0; e < free_edges_.size(); ++e)
    expand(constant.edge_block(e), matrix.edge_block(e));
  for (Index j = 0; j < free_nodes(); ++j) {
    expand(constant.diagonal_block(j), matrix.diagonal_block(j));
    Eigen::Map<Block> block(matrix.diagonal_block(j));
    const Eigen::Matrix3d r = Eigen::Matrix3d::Identity() + displacement_gradient(x, j);
    for (const auto& [a, b] : kPairs) {
      // The gradient of one condition: r_b in column a of R, r_a in column b.
      Eigen::Matrix<double, 12, 1> g = Eigen::Matrix<double, 12, 1>::Zero();
      for (int row = 0; row < 3; ++row) {
        g[4 * row + a] += r(row, b);
        g[4 * row + b] += r(row, a);
      }
      block.noalias() += weights_.rotation * g * g.transpose();
    }
  }
}

}  // namespace pliant::embedded
