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

Eigen::Vector3d laplacian(const std::vector<std::pair<Index, double>>& entries, Index point,
                          const Points& x) {
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
  edges_ = table.ends;
  first_cell_.push_back(0);
  for (Index e = 0; e < table.size(); ++e) {
    const auto [a, b] = edges_[e];
    for (int k = 0; k < 3; ++k) rest_edges_.push_back(rest_(k, a) - rest_(k, b));
    const double weight = rims ? weights[e] : std::max(weights[e], 0.0);
    cells_.push_back({a, weight});
    cells_.push_back({b, weight});
    for (Index t : table.triangles.row(e)) {
      if (!rims) break;
      const int c = corner_across(triangles, t, a, b);
      cells_.push_back({triangles(c, t), cotangents(c, t)});
    }
    first_cell_.push_back(cells_.size());
  }
  if (options.smoothness > 0.0) add_rows(triangles, table, cotangents, weights, options.smoothness);
  covariances_.resize(9, rest_.cols());
}

void ArapModel::add_rows(const Triangles& triangles, const EdgeTable& table,
                         const Points& cotangents, const std::vector<double>& weights,
                         double smoothness) {
  std::vector<double> area(rest_.cols(), 0.0);
  for (Index t = 0; t < triangles.cols(); ++t) {
    // Half cotangents times squared edges sum up to twice the area.
    double twice = 0.0;
    for (int c = 0; c < 3; ++c) {
      twice += cotangents(c, t) *
               (rest_.col(triangles((c + 1) % 3, t)) - rest_.col(triangles((c + 2) % 3, t)))
                   .squaredNorm();
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
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    double weight = kLeastMetric;
    for (std::size_t c = first_cell_[e]; c < first_cell_[e + 1]; ++c) weight += cells_[c].weight;
    matrix.off_diagonal[e] = -weight;
    for (Index end : edges_[e]) matrix.diagonal[end] += weight;
  }
  if (rows_.empty()) return matrix;

  // Products of the Laplacian's rows reach two edges far.
  std::vector<std::pair<Edge, double>> far;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    far.push_back({edges_[e], matrix.off_diagonal[e]});
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
  matrix.sum_off_diagonal(std::move(far));
  return matrix;
}

double ArapModel::evaluate(const Points& x, Points& half_gradient) {
  covariances_.setZero();
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const double* a = x.data() + 3 * edges_[e][0];
    const double* b = x.data() + 3 * edges_[e][1];
    const double* rest = &rest_edges_[3 * e];
    double product[9];
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) product[3 * c + r] = (a[r] - b[r]) * rest[c];
    }
    for (std::size_t c = first_cell_[e]; c < first_cell_[e + 1]; ++c) {
      double* s = covariances_.data() + 9 * static_cast<std::ptrdiff_t>(cells_[c].point);
      const dense::Vec2 weight = dense::splat2(cells_[c].weight);
      for (int k = 0; k < 8; k += 2) {
        dense::store2(s + k, dense::load2(s + k) + weight * dense::load2(product + k));
      }
      s[8] += cells_[c].weight * product[8];
    }
  }
  for (const Row& row : rows_) {
    Eigen::Map<Eigen::Matrix3d>(covariances_.col(row.point).data()) +=
        row.weight * laplacian(row.entries, row.point, x) *
        laplacian(row.entries, row.point, rest_).transpose();
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

std::array<double, 2> ArapModel::residuals(const Points& from, const Rotations& turns,
                                           const Points& x, Points& half_gradient) const {
  half_gradient.setZero(3, x.cols());
  double edges = 0.0, rows = 0.0;
  const bool at_rest = &from == &rest_;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const std::ptrdiff_t a = 3 * static_cast<std::ptrdiff_t>(edges_[e][0]);
    const std::ptrdiff_t b = 3 * static_cast<std::ptrdiff_t>(edges_[e][1]);
    double before[3], now[3], force[3] = {};
    for (int k = 0; k < 3; ++k) {
      before[k] = at_rest ? rest_edges_[3 * e + k] : from.data()[a + k] - from.data()[b + k];
      now[k] = x.data()[a + k] - x.data()[b + k];
    }
    for (std::size_t c = first_cell_[e]; c < first_cell_[e + 1]; ++c) {
      const double* turn = turns.data() + 9 * static_cast<std::ptrdiff_t>(cells_[c].point);
      const double weight = cells_[c].weight;
      for (int k = 0; k < 3; ++k) {
        const double d =
            now[k] - (turn[k] * before[0] + turn[3 + k] * before[1] + turn[6 + k] * before[2]);
        edges += weight * d * d;
        force[k] += weight * d;
      }
    }
    for (int k = 0; k < 3; ++k) {
      half_gradient.data()[a + k] += force[k];
      half_gradient.data()[b + k] -= force[k];
    }
  }
  for (const Row& row : rows_) {
    const Eigen::Vector3d d =
        laplacian(row.entries, row.point, x) -
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
