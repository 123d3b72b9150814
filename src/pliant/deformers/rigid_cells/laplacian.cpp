#include "pliant/deformers/rigid_cells/laplacian.h"

namespace pliant::cells {
namespace {

constexpr int kMostIterations = 400;

/// The Laplacian of the cells' graph times x, zero where cells are held.
Eigen::VectorXd product(const CellModel& model, const std::vector<bool>& held, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(model.size());
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const auto [i, j] = model.pairs[p];
    const double flow = model.weights[p] * (x[i] - x[j]);
    y[i] += flow;
    y[j] -= flow;
  }
  for (Index i = 0; i < model.size(); ++i) {
    if (held[i]) y[i] = 0.0;
  }
  return y;
}

/// Makes product(x) = right where cells are free, by conjugate gradients scaled by the diagonal.
void solve(const CellModel& model, const std::vector<bool>& held, const Eigen::VectorXd& right, double tolerance,
           Eigen::VectorXd& x) {
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(model.size());
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    for (const Index cell : model.pairs[p]) inverse[cell] += model.weights[p];
  }
  for (Index i = 0; i < model.size(); ++i) inverse[i] = held[i] || inverse[i] == 0.0 ? 0.0 : 1.0 / inverse[i];
  Eigen::VectorXd residual = right - product(model, held, x), direction = Eigen::VectorXd::Zero(model.size());
  double before = 0.0, first = 0.0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const Eigen::VectorXd scaled = residual.cwiseProduct(inverse);
    const double now = residual.dot(scaled);
    if (iteration == 0) first = now;
    if (!(now > tolerance * tolerance * first)) break;
    direction = scaled + (iteration == 0 ? 0.0 : now / before) * direction;
    const Eigen::VectorXd along = product(model, held, direction);
    const double curvature = direction.dot(along);
    if (!(curvature > 0.0)) break;
    x += now / curvature * direction;
    residual -= now / curvature * along;
    before = now;
  }
}

}  // namespace

Eigen::VectorXd harmonic_shares(const CellModel& model, const std::vector<bool>& held, const std::vector<Index>& of) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.size());
  for (const Index cell : of) x[cell] = 1.0;
  solve(model, held, Eigen::VectorXd::Zero(model.size()), 1e-3, x);
  return x;
}

void settle_centers(const CellModel& model, const std::vector<bool>& held, std::vector<CellMotion>& motions) {
  Points right = Points::Zero(3, model.size());
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const auto [i, j] = model.pairs[p];
    const Glue& glue = model.glue[p];
    const Eigen::Vector3d pull =
        (glue.weight_i * motions[j].rotation + glue.weight_j * motions[i].rotation) * glue.apart;
    right.col(i) += pull;
    right.col(j) -= pull;
  }
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd x(model.size());
    for (Index i = 0; i < model.size(); ++i) x[i] = motions[i].center[k];
    solve(model, held, right.row(k).transpose(), 1e-5, x);
    for (Index i = 0; i < model.size(); ++i) {
      if (!held[i]) motions[i].center[k] = x[i];
    }
  }
}

}  // namespace pliant::cells
