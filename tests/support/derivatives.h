// Central differences, the one helper that checks every analytic derivative.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace pliant::test {

/// Gradient of a function of n numbers by central differences with step h.
inline Eigen::VectorXd central_differences(const std::function<double(const Eigen::VectorXd&)>& f,
                                           const Eigen::VectorXd& x, double h = 1e-5) {
  Eigen::VectorXd gradient(x.size()), y = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    y[i] = x[i] + h;
    const double above = f(y);
    y[i] = x[i] - h;
    gradient[i] = (above - f(y)) / (2.0 * h);
    y[i] = x[i];
  }
  return gradient;
}

}  // namespace pliant::test
