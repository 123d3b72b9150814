// Limited-memory BFGS directions in a given metric (Nocedal & Wright, Numerical Optimization,
// algorithm 7.4, with the inverse metric in the place of the initial Hessian).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pliant/linalg/dense_kernels.h"

namespace pliant {

class Lbfgs {
 public:
  explicit Lbfgs(int pairs = 8) : capacity_(pairs) {}

  /// Forgets everything; n unknowns from now on. Allocates.
  void reset(Eigen::Index n);
  /// Forgets the pairs, keeps the memory.
  void clear() { used_ = 0; }
  bool empty() const { return used_ == 0; }

  /// Takes a step s and the change y of the gradient along it; ignored unless s'y > 0.
  void remember(const Eigen::VectorXd& s, const Eigen::VectorXd& y);

  /// d <- -H gradient. apply_inverse_metric(d) must replace d by M^-1 d.
  template <class ApplyInverseMetric>
  void direction(const Eigen::VectorXd& gradient, ApplyInverseMetric&& apply_inverse_metric, Eigen::VectorXd& d) {
    d = -gradient;
    for (int i = 0; i < used_; ++i) {
      const int at = slot(i);
      alpha_[at] = rho_[at] * dense::dot(s_[at].data(), d.data(), d.size());
      d -= alpha_[at] * y_[at];
    }
    apply_inverse_metric(d);
    for (int i = used_ - 1; i >= 0; --i) {
      const int at = slot(i);
      const double beta = rho_[at] * dense::dot(y_[at].data(), d.data(), d.size());
      d += (alpha_[at] - beta) * s_[at];
    }
  }

 private:
  /// Place of the i-th newest pair.
  int slot(int i) const { return (newest_ - i + capacity_) % capacity_; }

  int capacity_;
  int used_ = 0;
  int newest_ = 0;
  std::vector<Eigen::VectorXd> s_, y_;
  std::vector<double> rho_, alpha_;
};

}  // namespace pliant
