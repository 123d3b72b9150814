#include "pliant/solve/lbfgs.h"

#include <algorithm>
#include <cmath>

namespace pliant {

void Lbfgs::reset(Eigen::Index n) {
  used_ = 0;
  newest_ = 0;
  s_.resize(capacity_);
  y_.resize(capacity_);
  for (int i = 0; i < capacity_; ++i) {
    s_[i].resize(n);
    y_[i].resize(n);
  }
  rho_.assign(capacity_, 0.0);
  alpha_.assign(capacity_, 0.0);
}

void Lbfgs::remember(const Eigen::VectorXd& s, const Eigen::VectorXd& y) {
  const auto dot = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return dense::dot(a.data(), b.data(), a.size());
  };
  const double curvature = dot(s, y);
  // Pairs without clear positive curvature would make the metric indefinite.
  if (!(curvature > 1e-12 * std::sqrt(dot(s, s)) * std::sqrt(dot(y, y)))) return;
  newest_ = (newest_ + 1) % capacity_;
  used_ = std::min(used_ + 1, capacity_);
  s_[newest_] = s;
  y_[newest_] = y;
  rho_[newest_] = 1.0 / curvature;
}

}  // namespace pliant
