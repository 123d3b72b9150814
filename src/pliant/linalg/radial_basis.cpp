#include "pliant/linalg/radial_basis.h"

#include <cmath>
#include <utility>

#include "pliant/linalg/dense_kernels.h"
#include "pliant/linalg/substitution.h"

namespace pliant {
namespace {

/// Centres closer to a line or plane than this, of their extent, lie in it.
constexpr double kFlat = 1e-6;
/// Added to the diagonal, of its mean.
constexpr double kRidge = 1e-13;

double kernel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double squared = (a - b).squaredNorm();
  return squared * std::sqrt(squared);
}

}  // namespace

// With Lagrange polynomials p_b of the base the kernel
//   K(x, y) = phi(x, y) - sum p_b(x) phi(b, y) - sum p_b(y) phi(x, b) + sum p_a(x) p_b(y) phi(a, b)
// is positive definite over the other centres (phi is conditionally positive definite of order two),
// so that Cholesky serves, and weights of the base follow from reproducing the polynomials.
RadialBasis::RadialBasis(Points centers) : centers_(std::move(centers)) {
  choose_base();
  const Index n = size(), m = static_cast<Index>(rest_.size()), base = static_cast<Index>(base_.size());
  at_base_.resize(n, base);
  for (Index b = 0; b < base; ++b) {
    for (Index c = 0; c < n; ++c) at_base_(c, b) = kernel(centers_.col(c), centers_.col(base_[b]));
  }
  polynomials_.resize(base, m);
  for (Index i = 0; i < m; ++i) polynomials_.col(i) = base_polynomials(centers_.col(rest_[i]));
  const Eigen::MatrixXd among = at_base_(base_, Eigen::all);
  const Eigen::MatrixXd outer = at_base_(rest_, Eigen::all);
  const Eigen::MatrixXd half = 0.5 * (polynomials_.transpose() * among) - outer;  // m x base
  factor_.resize(static_cast<std::size_t>(m) * m);
  Eigen::Map<Eigen::MatrixXd> gram(factor_.data(), m, m);
  gram.noalias() = half * polynomials_;
  gram += gram.transpose().eval();
  for (Index j = 0; j < m; ++j) {
    for (Index i = 0; i < m; ++i) gram(i, j) += kernel(centers_.col(rest_[i]), centers_.col(rest_[j]));
  }
  if (m == 0) return;
  gram.diagonal().array() += kRidge * gram.diagonal().mean();
  packed_.resize(dense::packed_size(m));
  dense::factorize_panel(factor_.data(), m, m, m, packed_.data());
}

void RadialBasis::choose_base() {
  // Each next one is the farthest from the span of those before.
  Points away = centers_.colwise() - centers_.col(0);
  std::vector<bool> taken(centers_.cols(), false);
  base_.push_back(0);
  taken[0] = true;
  double extent = 0.0;
  for (int k = 0; k < 3; ++k) {
    Index farthest = 0;
    const double distance = std::sqrt(away.colwise().squaredNorm().maxCoeff(&farthest));
    if (k == 0) extent = distance;
    if (!(distance > kFlat * extent)) break;
    directions_.col(k) = away.col(farthest) / distance;
    away -= directions_.col(k) * (directions_.col(k).transpose() * away).eval();
    edges_.col(k) = directions_.transpose() * (centers_.col(farthest) - centers_.col(0));
    base_.push_back(farthest);
    taken[farthest] = true;
  }
  for (Index c = 0; c < size(); ++c) {
    if (!taken[c]) rest_.push_back(c);
  }
}

Eigen::VectorXd RadialBasis::base_polynomials(const Eigen::Vector3d& place) const {
  const Index others = static_cast<Index>(base_.size()) - 1;
  Eigen::VectorXd values(others + 1);
  const Eigen::Vector3d along = directions_.transpose() * (place - centers_.col(0));
  double rest = 1.0;
  for (Index k = others - 1; k >= 0; --k) {
    double value = along[k];
    for (Index l = k + 1; l < others; ++l) value -= edges_(k, l) * values[l + 1];
    values[k + 1] = value / edges_(k, k);
    rest -= values[k + 1];
  }
  values[0] = rest;
  return values;
}

Eigen::VectorXd RadialBasis::weights(const Points& places, const Eigen::VectorXd& factors) {
  const Index m = static_cast<Index>(rest_.size());
  Eigen::VectorXd polynomial = Eigen::VectorXd::Zero(base_.size());
  Eigen::VectorXd kernels = Eigen::VectorXd::Zero(size());
  for (Index p = 0; p < places.cols(); ++p) {
    polynomial += factors[p] * base_polynomials(places.col(p));
    for (Index c = 0; c < size(); ++c) kernels[c] += factors[p] * kernel(places.col(p), centers_.col(c));
  }
  const Eigen::VectorXd at_base = kernels(base_) - at_base_(base_, Eigen::all) * polynomial;
  Eigen::VectorXd solved = kernels(rest_) - at_base_(rest_, Eigen::all) * polynomial;
  solved -= polynomials_.transpose() * at_base;
  if (m > 0) {
    const int rows = static_cast<int>(m);
    dense::forward_panel<dense::One>(factor_.data(), rows, rows, solved.data(), nullptr);
    dense::backward_panel<dense::One>(factor_.data(), rows, rows, solved.data(), nullptr);
  }
  Eigen::VectorXd all(size());
  all(base_) = polynomial - polynomials_ * solved;
  all(rest_) = solved;
  return all;
}

}  // namespace pliant
