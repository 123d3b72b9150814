#include "pliant/deformers/arap/model.h"

#include <algorithm>
#include <numeric>

#include "pliant/deformers/arap/rotations.h"
#include "pliant/geometry/cotangent.h"
#include "pliant/linalg/dense_kernels.h"

namespace pliant::arap {
namespace {

/// Every edge weighs at least this in the matrix, which is a metric: an edge whose cotangents
/// cancel must not let a point float. The energy does not know it.
constexpr double kLeastMetric = 1e-6;

using ConstMatrix = Eigen::Map<const Eigen::Matrix3d>;
using dense::Vec2;

const double* at(const Points& x, Index point) { return x.data() + 3 * static_cast<std::ptrdiff_t>(point); }
double* at(Points& x, Index point) { return x.data() + 3 * static_cast<std::ptrdiff_t>(point); }

Eigen::Vector3d laplacian(const std::vector<std::pair<Index, double>>& entries, Index point, const Points& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [neighbour, weight] : entries) sum += weight * (x.col(point) - x.col(neighbour));
  return sum;
}

}  // namespace

ArapModel::ArapModel(const Shape& shape, const ArapOptions& options)
    : rest_(shape.points()), planar_(shape.dimension() == 2) {
  const Triangles& triangles = shape.triangles();
  const Points cotangents = half_cotangents(rest_, triangles);
  const EdgeTable table = unique_edges(triangles, static_cast<Index>(rest_.cols()));
  const std::vector<double> weights = cotangent_weights(cotangents, triangles, table);
  const bool rims = options.energy == ArapEnergy::spokes_and_rims;
  cells_a_spoke_ = rims ? 4 : 2;
  edges_ = table.ends;
  for (Index e = 0; e < table.size(); ++e) {
    const auto [a, b] = edges_[e];
    const Eigen::Vector3d rest = rest_.col(a) - rest_.col(b);
    const Spoke bare{{a, b, a, b}, {0.0, 0.0, 0.0}, {rest[0], rest[1], rest[2]}};
    spokes_.push_back(bare);
    spokes_.back().weights[0] = rims ? weights[e] : std::max(weights[e], 0.0);
    if (!rims) continue;
    int across = 0;
    for (Index t : table.triangles.row(e)) {
      if (across == 2) {
        spokes_.push_back(bare);
        across = 0;
      }
      const int c = corner_across(triangles, t, a, b);
      spokes_.back().cells[2 + across] = triangles(c, t);
      spokes_.back().weights[1 + across] = cotangents(c, t);
      ++across;
    }
  }
  if (options.smoothness > 0.0) add_rows(triangles, table, cotangents, weights, options.smoothness);
  covariances_.resize(9, rest_.cols());
}

template <class F>
void ArapModel::for_spokes(F f) const {
  std::size_t edge = 0;
  for (const Spoke& spoke : spokes_) {
    if (spoke.cells[0] != edges_[edge][0] || spoke.cells[1] != edges_[edge][1]) ++edge;
    f(spoke, edge);
  }
}

std::vector<double> ArapModel::spoke_weights() const {
  std::vector<double> weights(edges_.size(), 0.0);
  for_spokes([&](const Spoke& spoke, std::size_t edge) { weights[edge] += spoke.weights[0]; });
  return weights;
}

void ArapModel::add_rows(const Triangles& triangles, const EdgeTable& table, const Points& cotangents,
                         const std::vector<double>& weights, double smoothness) {
  std::vector<double> area(rest_.cols(), 0.0);
  for (Index t = 0; t < triangles.cols(); ++t) {
    // Half cotangents times squared edges sum up to twice the area.
    double twice = 0.0;
    for (int c = 0; c < 3; ++c) {
      twice += cotangents(c, t) *
               (rest_.col(triangles((c + 1) % 3, t)) - rest_.col(triangles((c + 2) % 3, t))).squaredNorm();
    }
    for (Index corner : triangles.col(t)) area[corner] += twice / 6.0;
  }
  std::vector<std::vector<std::pair<Index, double>>> entries(rest_.cols());
  std::vector<bool> inner(rest_.cols(), true);
  for (Index e = 0; e < table.size(); ++e) {
    const auto [a, b] = table.ends[e];
    entries[a].emplace_back(b, weights[e]);
    entries[b].emplace_back(a, weights[e]);
    if (table.triangles.row(e).size() == 1) inner[a] = inner[b] = false;
  }
  const double squared = smoothness * smoothness * std::accumulate(area.begin(), area.end(), 0.0);
  for (Index i = 0; i < rest_.cols(); ++i) {
    if (!inner[i] || !(area[i] > 0.0)) continue;
    rows_.push_back({i, squared / area[i], std::move(entries[i])});
  }
}

BlockMatrix ArapModel::matrix() const {
  BlockMatrix matrix;
  matrix.set_zero(1, static_cast<Index>(rest_.cols()), edges_);
  std::fill(matrix.off_diagonal.begin(), matrix.off_diagonal.end(), -kLeastMetric);
  for_spokes([&](const Spoke& spoke, std::size_t edge) {
    matrix.off_diagonal[edge] -= 2.0 * spoke.weights[0] + spoke.weights[1] + spoke.weights[2];
  });
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    for (Index end : edges_[e]) matrix.diagonal[end] -= matrix.off_diagonal[e];
  }
  if (rows_.empty()) return matrix;

  // Products of the Laplacian's rows reach two edges far.
  std::vector<std::pair<Edge, double>> far;
  for (std::size_t e = 0; e < edges_.size(); ++e) far.push_back({edges_[e], matrix.off_diagonal[e]});
  for (const Row& row : rows_) {
    std::vector<std::pair<Index, double>> entries = row.entries;
    double sum = 0.0;
    for (auto& [neighbour, weight] : entries) {
      sum += weight;
      weight = -weight;
    }
    entries.emplace_back(row.point, sum);
    for (const auto& [a, u] : entries) {
      matrix.diagonal[a] += row.weight * u * u;
      for (const auto& [b, v] : entries) {
        if (a < b) far.push_back({{a, b}, row.weight * u * v});
      }
    }
  }
  matrix.sum_off_diagonal(far);
  return matrix;
}

double ArapModel::evaluate(const Points& x, Points& half_gradient) {
  covariances_.setZero();
  for (const Spoke& spoke : spokes_) {
    const double* a = at(x, spoke.cells[0]);
    const double* b = at(x, spoke.cells[1]);
    double product[9];
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) product[3 * c + r] = (a[r] - b[r]) * spoke.rest[c];
    }
    for (int c = 0; c < cells_a_spoke_; ++c) {
      double* s = covariances_.data() + 9 * static_cast<std::ptrdiff_t>(spoke.cells[c]);
      const double weight = spoke.weight_of(c);
      const Vec2 weights = dense::splat2(weight);
      for (int k = 0; k < 8; k += 2) {
        dense::store2(s + k, dense::load2(s + k) + weights * dense::load2(product + k));
      }
      s[8] += weight * product[8];
    }
  }
  for (const Row& row : rows_) {
    Eigen::Map<Eigen::Matrix3d>(covariances_.col(row.point).data()) +=
        row.weight * laplacian(row.entries, row.point, x) * laplacian(row.entries, row.point, rest_).transpose();
  }
  if (x == rest_) {
    // Exactly at rest the energy is exactly zero.
    rotations_ = Eigen::Matrix3d::Identity().reshaped().replicate(1, x.cols());
  } else {
    fit_rotations(covariances_, planar_, rotations_);
  }
  const auto parts = residuals(rest_, rotations_, x, half_gradient);
  rigidity_ = parts[0];
  smoothness_ = parts[1];
  return rigidity_ + smoothness_;
}

void ArapModel::turned_gradient(const Points& from, const Rotations& turns, const Points& x,
                                Points& half_gradient) const {
  residuals(from, turns, x, half_gradient);
}

double ArapModel::edge_residuals(const Points& from, const Rotations& turns, const Points& x,
                                 Points& half_gradient) const {
  // Two cells at a time: their first two coordinates each, and the third of both.
  Vec2 sum = {};
  const bool at_rest = &from == &rest_;
  for (const Spoke& spoke : spokes_) {
    const double *a = at(x, spoke.cells[0]), *b = at(x, spoke.cells[1]);
    const Vec2 now = dense::load2(a) - dense::load2(b), now_z = dense::splat2(a[2] - b[2]);
    Vec2 before[3];
    for (int k = 0; k < 3; ++k) {
      before[k] = dense::splat2(at_rest ? spoke.rest[k] : at(from, spoke.cells[0])[k] - at(from, spoke.cells[1])[k]);
    }
    Vec2 force = {}, force_z = {};
    for (int c = 0; c < cells_a_spoke_; c += 2) {
      const double* one = turns.data() + 9 * static_cast<std::ptrdiff_t>(spoke.cells[c]);
      const double* two = turns.data() + 9 * static_cast<std::ptrdiff_t>(spoke.cells[c + 1]);
      Vec2 d_one = now, d_two = now, d_z = now_z;
      for (int k = 0; k < 3; ++k) {
        d_one -= dense::load2(one + 3 * k) * before[k];
        d_two -= dense::load2(two + 3 * k) * before[k];
        d_z -= Vec2{one[3 * k + 2], two[3 * k + 2]} * before[k];
      }
      const double w_one = spoke.weight_of(c), w_two = spoke.weight_of(c + 1);
      const Vec2 f_one = w_one * d_one, f_two = w_two * d_two, f_z = Vec2{w_one, w_two} * d_z;
      sum += f_one * d_one + f_two * d_two + f_z * d_z;
      force += f_one + f_two;
      force_z += f_z;
    }
    const double z = force_z[0] + force_z[1];
    double *to_a = at(half_gradient, spoke.cells[0]), *to_b = at(half_gradient, spoke.cells[1]);
    dense::store2(to_a, dense::load2(to_a) + force);
    to_a[2] += z;
    dense::store2(to_b, dense::load2(to_b) - force);
    to_b[2] -= z;
  }
  return sum[0] + sum[1];
}

std::array<double, 2> ArapModel::residuals(const Points& from, const Rotations& turns, const Points& x,
                                           Points& half_gradient) const {
  half_gradient.setZero(3, x.cols());
  const double edges = edge_residuals(from, turns, x, half_gradient);
  double rows = 0.0;
  for (const Row& row : rows_) {
    const Eigen::Vector3d d = laplacian(row.entries, row.point, x) -
                              ConstMatrix(turns.col(row.point).data()) * laplacian(row.entries, row.point, from);
    rows += row.weight * d.squaredNorm();
    for (const auto& [neighbour, weight] : row.entries) {
      half_gradient.col(row.point) += row.weight * weight * d;
      half_gradient.col(neighbour) -= row.weight * weight * d;
    }
  }
  return {edges, rows};
}

}  // namespace pliant::arap
