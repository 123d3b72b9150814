#include "pliant/sketch/parameter_smoother.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pliant {
namespace {

constexpr double kFidelityShare = 0.05;  // w_c / 2 over the sum of w: sum w = 10 w_c
constexpr double kRelaxation = 0.97;     // of what the incomplete factor leaves out
constexpr double kLeastLength = 1e-6;    // of the mean: points that all but coincide move as one
constexpr int kMaxPasses = 200;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

ParameterSmoother::ParameterSmoother(const Points& points, std::span<const Index> point_of_local, Index free,
                                     std::span<const std::array<Index, 2>> edges)
    : offsets_(free + 1, 0), fidelity_(free, 0.0), diagonal_(free, 0.0) {
  std::vector<double> sums(free, 0.0), weights, lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    lengths.push_back((points.col(point_of_local[a]) - points.col(point_of_local[b])).norm());
  }
  const double all = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const double least = all > 0.0 ? kLeastLength * all / static_cast<double>(lengths.size()) : 1.0;
  weights.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    const auto [low, high] = std::minmax(a, b);
    const double w = 1.0 / std::max(least, lengths[weights.size()]);
    weights.push_back(w);
    if (low < free) sums[low] += w;
    if (high < free) {
      sums[high] += w;
      ++offsets_[high + 1];
    } else if (low < free) {
      links_.push_back({low, high - free, w});
    }
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  columns_.resize(offsets_.back());
  weights_.resize(offsets_.back());
  std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high] = std::minmax(edges[e][0], edges[e][1]);
    if (high >= free) continue;
    columns_[next[high]] = low;
    weights_[next[high]++] = weights[e];
  }
  for (Index i = 0; i < free; ++i) {
    fidelity_[i] = kFidelityShare * sums[i];
    diagonal_[i] = sums[i] + fidelity_[i];
  }
  factorize();
  for (auto* vector : {&r_, &z_, &p_, &t_, &q_}) vector->assign(free, 0.0);
}

/// Modified incomplete Cholesky of the diagonal alone (Gustafsson 1978): what would fill in is
/// taken from the diagonal, so that constants are kept and the condition becomes its square root.
void ParameterSmoother::factorize() {
  const Index n = size();
  std::vector<double> pivot = diagonal_;
  std::vector<double> above(n, 0.0);  // sum of the weights of later neighbours
  for (Index i = 0; i < n; ++i) {
    for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) above[columns_[k]] += weights_[k];
  }
  for (Index i = 0; i < n; ++i) {
    for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const Index j = columns_[k];
      const double w = weights_[k];
      const double taken = w + kRelaxation * (above[j] - w);
      pivot[i] -= w * taken / pivot[j];
    }
  }
  scale_.resize(n);
  rest_.resize(n);
  mass_ = std::accumulate(pivot.begin(), pivot.end(), 0.0);
  for (Index i = 0; i < n; ++i) {
    scale_[i] = 1.0 / std::sqrt(pivot[i]);
    rest_[i] = diagonal_[i] / pivot[i] - 2.0;
  }
  lower_.resize(weights_.size());
  for (Index i = 0; i < n; ++i) {
    for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      lower_[k] = -weights_[k] * scale_[i] * scale_[columns_[k]];
    }
  }
}

void ParameterSmoother::forward(double* v) const {
  const Index n = size();
  for (Index i = 0; i < n; ++i) {
    double sum = v[i];
    for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) sum -= lower_[k] * v[columns_[k]];
    v[i] = sum;
  }
}

void ParameterSmoother::backward(double* v) const {
  for (Index i = size() - 1; i >= 0; --i) {
    const double value = v[i];
    for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) v[columns_[k]] -= lower_[k] * value;
  }
}

/// r_ = right-hand side - matrix u.
void ParameterSmoother::residual(std::span<const double> raw, std::span<const double> pinned,
                                 std::span<const double> u) {
  const Index n = size();
  for (Index i = 0; i < n; ++i) r_[i] = fidelity_[i] * raw[i] - diagonal_[i] * u[i];
  for (const Link& link : links_) r_[link.free] += link.weight * pinned[link.pinned];
  for (Index i = 0; i < n; ++i) {
    double sum = 0.0;
    for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      sum += weights_[k] * u[columns_[k]];
      r_[columns_[k]] += weights_[k] * u[i];
    }
    r_[i] += sum;
  }
}

int ParameterSmoother::solve(std::span<const double> raw, std::span<const double> pinned, std::span<double> u,
                             double tolerance) {
  const Index n = size();
  double largest = 0.0;
  for (const double value : raw) largest = std::max(largest, std::abs(value));
  for (const double value : pinned) largest = std::max(largest, std::abs(value));
  const double enough = tolerance * tolerance * largest * largest * mass_;

  // Eisenstat's way (1981): the matrix is never multiplied, two triangular passes do both it and
  // the preconditioner.
  residual(raw, pinned, u);
  for (Index i = 0; i < n; ++i) r_[i] *= scale_[i];
  forward(r_.data());
  std::fill(z_.begin(), z_.end(), 0.0);
  p_ = r_;
  double square = dot(r_, r_);
  int passes = 0;
  for (; square > enough && passes < kMaxPasses; ++passes) {
    t_ = p_;
    backward(t_.data());
    for (Index i = 0; i < n; ++i) q_[i] = p_[i] + rest_[i] * t_[i];
    forward(q_.data());
    for (Index i = 0; i < n; ++i) q_[i] += t_[i];
    const double along = square / dot(p_, q_);
    for (Index i = 0; i < n; ++i) {
      z_[i] += along * p_[i];
      r_[i] -= along * q_[i];
    }
    const double next = dot(r_, r_);
    const double keep = next / square;
    for (Index i = 0; i < n; ++i) p_[i] = r_[i] + keep * p_[i];
    square = next;
  }
  backward(z_.data());
  for (Index i = 0; i < n; ++i) u[i] += scale_[i] * z_[i];
  return passes;
}

}  // namespace pliant
