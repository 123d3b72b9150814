#include "pliant/deformers/embedded_graph/energy.h"

#include <algorithm>
#include <cmath>

#include "pliant/linalg/dense_kernels.h"

namespace pliant::embedded {
namespace {

using dense::Vec2;

/// 3 x 3 matrices of two nodes side by side, [row][column]: the compiler for WASM does not find
/// this by itself.
using TwoMatrices = std::array<std::array<Vec2, 3>, 3>;

/// The six conditions of eq. 5 on R = I + U, of two nodes: c1.c2, c1.c3, c2.c3, and c_i.c_i - 1.
using Conditions = std::array<Vec2, 6>;
constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {1, 2}, {0, 0}, {1, 1}, {2, 2}};

/// Dot product of column a of m and column b of n.
Vec2 columns(const TwoMatrices& m, int a, const TwoMatrices& n, int b) {
  return m[0][a] * n[0][b] + m[1][a] * n[1][b] + m[2][a] * n[2][b];
}

/// In displacements, so that conditions near rest keep their digits.
Conditions conditions(const TwoMatrices& u) {
  Conditions f;
  for (int q = 0; q < 6; ++q) {
    const auto [a, b] = kPairs[q];
    f[q] = u[a][b] + u[b][a] + columns(u, a, u, b);
  }
  return f;
}

/// Derivatives of the conditions at R along D.
Conditions conditions_along(const TwoMatrices& r, const TwoMatrices& d) {
  Conditions f;
  for (int q = 0; q < 6; ++q) {
    const auto [a, b] = kPairs[q];
    f[q] = columns(r, a, d, b) + columns(r, b, d, a);
  }
  return f;
}

/// Their second-order part along D.
Conditions conditions_across(const TwoMatrices& d) {
  Conditions f;
  for (int q = 0; q < 6; ++q) f[q] = columns(d, kPairs[q][0], d, kPairs[q][1]);
  return f;
}

/// I + U.
TwoMatrices affine_of(TwoMatrices u) {
  for (int i = 0; i < 3; ++i) u[i][i] += 1.0;
  return u;
}

/// The U of free nodes j and k.
TwoMatrices gradients(const GraphEnergy& energy, const Vector& x, Index j, Index k) {
  TwoMatrices u;
  for (int a = 0; a < 3; ++a) {
    const double *one = energy.entry(x, a, j), *two = energy.entry(x, a, k);
    for (int c = 0; c < 3; ++c) u[a][c] = Vec2{one[c], two[c]};
  }
  return u;
}

/// Rot(R) of both (eq. 5).
Vec2 rotation_terms_of(const TwoMatrices& u) {
  Vec2 sum = {};
  for (const Vec2& f : conditions(u)) sum += f * f;
  return sum;
}

double dot(const Points& a, const Points& b) { return dense::dot(a.data(), b.data(), a.size()); }

void add_outer(double* block, const Eigen::Vector4d& rows, const Eigen::Vector4d& columns, double w = 1.0) {
  const dense::Vec2 r01 = dense::load2(rows.data()), r23 = dense::load2(rows.data() + 2);
  for (int c = 0; c < 4; ++c, block += 4) {
    const dense::Vec2 scale = dense::splat2(w * columns[c]);
    dense::store2(block, dense::load2(block) + r01 * scale);
    dense::store2(block + 2, dense::load2(block + 2) + r23 * scale);
  }
}

}  // namespace

double Quartic::first_minimum() const {
  // Newton on the derivative from the left, safeguarded by a bracket. The derivative starts below
  // zero and its leading coefficient is not negative, so it crosses zero unless the course is flat.
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

void GraphEnergy::set_up(const DeformationGraph& graph, const std::vector<bool>& frozen, const Points& constrained,
                         const Influences& influences, const Weights& weights) {
  weights_ = weights;
  all_nodes_ = graph.size();
  const Points g = graph.scaled(graph.nodes);
  free_of_node_.assign(graph.size(), -1);
  node_of_free_.clear();
  for (Index j = 0; j < graph.size(); ++j) {
    if (frozen[j]) continue;
    free_of_node_[j] = free_nodes();
    node_of_free_.push_back(j);
  }

  edges_.clear();
  free_edges_.clear();
  free_edge_index_.clear();
  for (const auto& [j, k] : graph.edges) {
    if (frozen[j] && frozen[k]) continue;  // at rest on both ends: no energy
    edges_.push_back({free_of_node_[j], free_of_node_[k], g.col(k) - g.col(j)});
    const bool is_free = !frozen[j] && !frozen[k];
    free_edge_index_.push_back(is_free ? static_cast<Index>(free_edges_.size()) : -1);
    if (is_free) free_edges_.push_back({free_of_node_[j], free_of_node_[k]});
  }

  constraints_.set_up(constrained, influences, g, free_of_node_, free_nodes(), free_edges_);
  reg_.resize(3, 2 * static_cast<Index>(edges_.size()));
  reg_along_.resizeLike(reg_);
}

Eigen::Matrix3d GraphEnergy::displacement_gradient(const Vector& x, Index j) const {
  Eigen::Matrix3d u;
  for (int a = 0; a < 3; ++a) u.row(a) = Eigen::Map<const Eigen::RowVector3d>(entry(x, a, j));
  return u;
}

Eigen::Vector3d GraphEnergy::translation(const Vector& x, Index j) const {
  return {entry(x, 0, j)[3], entry(x, 1, j)[3], entry(x, 2, j)[3]};
}

void GraphEnergy::set_displacement_gradient(Vector& x, Index j, const Eigen::Matrix3d& u) const {
  for (int a = 0; a < 3; ++a) Eigen::Map<Eigen::RowVector3d>(entry(x, a, j)) = u.row(a);
}

void GraphEnergy::set_translation(Vector& x, Index j, const Eigen::Vector3d& t) const {
  for (int a = 0; a < 3; ++a) entry(x, a, j)[3] = t[a];
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

template <class F>
void GraphEnergy::for_node_pairs(F f) const {
  for (Index j = 0; j < free_nodes(); j += 2) {
    const bool both = j + 1 < free_nodes();
    f(j, both ? j + 1 : j, Vec2{1.0, both ? 1.0 : 0.0});
  }
}

double GraphEnergy::rotation_terms(const Vector& x) const {
  Vec2 sum = {};
  for_node_pairs([&](Index j, Index k, Vec2 counts) { sum += counts * rotation_terms_of(gradients(*this, x, j, k)); });
  return sum[0] + sum[1];
}

void GraphEnergy::evaluate(const Vector& x) {
  regularization_residuals(x, reg_);
  terms_ = {rotation_terms(x), dot(reg_, reg_), constraints_.evaluate(x), 0.0};
  evaluated_constraint_ = terms_.constraint;
}

void GraphEnergy::advance(double alpha, const Vector& x) {
  const double constraint = terms_.constraint + alpha * (con_along_.slope + alpha * con_along_.curvature);
  // What is left after such a fall, in however many steps, is mostly rounding.
  if (!(constraint > 1e-4 * evaluated_constraint_)) return evaluate(x);
  reg_ += alpha * reg_along_;
  constraints_.advance(alpha);
  terms_ = {rotation_terms(x), dot(reg_, reg_), constraint, 0.0};
}

void GraphEnergy::retreat(double alpha, const Terms& terms) {
  reg_ -= alpha * reg_along_;
  constraints_.advance(-alpha);
  terms_ = terms;
}

void GraphEnergy::node_terms(const Vector& x, std::vector<double>& rotation,
                             std::vector<double>& regularization) const {
  rotation.assign(all_nodes_, 0.0);
  regularization.assign(all_nodes_, 0.0);
  for (Index j = 0; j < free_nodes(); ++j) rotation[node_of_free_[j]] = rotation_terms_of(gradients(*this, x, j, j))[0];
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [j, k, d] = edges_[e];
    if (j >= 0) regularization[node_of_free_[j]] += reg_.col(2 * e).squaredNorm();
    if (k >= 0) regularization[node_of_free_[k]] += reg_.col(2 * e + 1).squaredNorm();
  }
}

std::vector<double> GraphEnergy::node_energies(const Vector& x) const {
  std::vector<double> energies, regularization;
  node_terms(x, energies, regularization);
  for (std::size_t j = 0; j < energies.size(); ++j) {
    energies[j] = weights_.rotation * energies[j] + weights_.regularization * regularization[j];
  }
  return energies;
}

void GraphEnergy::half_gradient(const Vector& x, Vector& gradient) const {
  gradient = weights_.constraint * constraints_.gradient();
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
  for_node_pairs([&](Index j, Index k, Vec2 counts) {
    const TwoMatrices u = gradients(*this, x, j, k), r = affine_of(u);
    const Conditions f = conditions(u);
    TwoMatrices g = {};  // of half of Rot(R)
    for (int q = 0; q < 6; ++q) {
      const auto [a, b] = kPairs[q];
      const Vec2 force = weights_.rotation * counts * f[q];
      for (int row = 0; row < 3; ++row) {
        g[row][a] += force * r[row][b];
        g[row][b] += force * r[row][a];
      }
    }
    for (int a = 0; a < 3; ++a) {
      double *one = entry(gradient, a, j), *two = entry(gradient, a, k);
      for (int c = 0; c < 3; ++c) one[c] += g[a][c][0];
      for (int c = 0; c < 3; ++c) two[c] += g[a][c][1];
    }
  });
}

Quartic GraphEnergy::along(const Vector& x, const Vector& d) {
  regularization_residuals(d, reg_along_);
  con_along_ = constraints_.along(d);
  Quartic course;
  auto& c = course.c;
  c[0] = total();
  c[1] = 2.0 * weights_.regularization * dot(reg_, reg_along_) + weights_.constraint * con_along_.slope;
  c[2] = weights_.regularization * dot(reg_along_, reg_along_) + weights_.constraint * con_along_.curvature;
  Vec2 sums[5] = {};
  for_node_pairs([&](Index j, Index k, Vec2 counts) {
    const TwoMatrices u = gradients(*this, x, j, k), step = gradients(*this, d, j, k);
    const Conditions f0 = conditions(u), f2 = conditions_across(step);
    const Conditions f1 = conditions_along(affine_of(u), step);
    for (int q = 0; q < 6; ++q) {
      sums[1] += counts * 2.0 * f0[q] * f1[q];
      sums[2] += counts * (f1[q] * f1[q] + 2.0 * f0[q] * f2[q]);
      sums[3] += counts * 2.0 * f1[q] * f2[q];
      sums[4] += counts * f2[q] * f2[q];
    }
  });
  for (int i = 1; i < 5; ++i) c[i] += weights_.rotation * (sums[i][0] + sums[i][1]);
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
  constraints_.add_to(matrix, weights_.constraint);
}

void GraphEnergy::gauss_newton_matrix(const Vector& x, const BlockMatrix& constant, BlockMatrix& matrix) const {
  if (!matrix.has_pattern(12, free_nodes(), free_edges_)) matrix.set_zero(12, free_nodes(), free_edges_);
  using Block = Eigen::Matrix<double, 12, 12>;
  auto expand = [](const double* from, double* to) {
    Eigen::Map<Block> block(to);
    block.setZero();
    for (int a = 0; a < 3; ++a) block.block<4, 4>(4 * a, 4 * a) = Eigen::Map<const Eigen::Matrix4d>(from);
  };
  for (std::size_t e = 0; e < free_edges_.size(); ++e) expand(constant.edge_block(e), matrix.edge_block(e));
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
