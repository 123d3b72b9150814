#include "pliant/deformers/edge_material/model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pliant/geometry/adjacency.h"

namespace pliant::edge_material {
namespace {

/// eps of kappa' = eps + (1 - eps) kappa: across the field the material is this soft, not absent.
constexpr double kLeastKappa = 0.01;
/// Without stretch stiffness flat parts have free affine modes; the matrix, a metric, holds them
/// with this much of (h / L)^2 mu. The energy does not know it.
constexpr double kLeastMetric = 0.01;
/// Hinges whose two lines meet at a smaller angle (sine), or whose feet lie further out than this
/// many lengths, are slivers: no bending term.
constexpr double kLeastSine = 0.02;
constexpr double kFarthestFoot = 10.0;
/// A hinge folded so far that its normal shrinks below this part keeps its previous normal.
constexpr double kFolded = 0.05;

Eigen::Vector3d rho_of(const EdgeElement& e, const Points& x) { return x.col(e.i) - x.col(e.j); }

Eigen::Vector3d sigma_of(const EdgeElement& e, const Points& x) {
  return e.alpha * x.col(e.i) + (1.0 - e.alpha) * x.col(e.j) - e.beta * x.col(e.l) - (1.0 - e.beta) * x.col(e.m);
}

/// Of the quadrilateral: along the normal of eq. 4.
Eigen::Vector3d area_of(const EdgeElement& e, const Points& x) { return (x.col(e.l) - x.col(e.m)).cross(rho_of(e, x)); }

void add_to_ends(const EdgeElement& e, const Eigen::Vector3d& force, Points& sum) {
  sum.col(e.i) += force;
  sum.col(e.j) -= force;
}

void add_to_hinge(const EdgeElement& e, const Eigen::Vector3d& force, Points& sum) {
  sum.col(e.i) += e.alpha * force;
  sum.col(e.j) += (1.0 - e.alpha) * force;
  sum.col(e.l) -= e.beta * force;
  sum.col(e.m) -= (1.0 - e.beta) * force;
}

}  // namespace

EdgeMaterialModel::EdgeMaterialModel(const Shape& shape)
    : rest_(shape.points()), anchored_(shape.points().cols(), true) {
  add_elements(shape.triangles());
  normals_.resize(3, static_cast<Index>(elements_.size()));
  least_normal_.assign(elements_.size(), 0.0);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const EdgeElement& e = elements_[k];
    if (e.l < 0) continue;
    const Eigen::Vector3d normal = area_of(e, rest_);
    least_normal_[k] = kFolded * normal.norm();
    normals_.col(static_cast<Index>(k)) = normal.normalized();
  }
  trial_normals_ = normals_;
}

void EdgeMaterialModel::add_elements(const Triangles& triangles) {
  const EdgeTable table = unique_edges(triangles, static_cast<Index>(rest_.cols()));
  double lengths = 0.0;
  for (Index k = 0; k < table.size(); ++k) {
    EdgeElement element{table.ends[k][0], table.ends[k][1]};
    element.rho = rho_of(element, rest_).norm();
    lengths += element.rho;
    const std::span<const Index> around = table.triangles.row(k);
    if (around.size() == 1) elements_.push_back(element);
    for (std::size_t a = 0; a < around.size(); ++a) {
      for (std::size_t b = a + 1; b < around.size(); ++b) {
        // l belongs to the triangle that walks from i to j, if the two agree on their sides.
        const auto across = [&](Index t) { return triangles(corner_across(triangles, t, element.i, element.j), t); };
        Index l = across(around[a]), m = across(around[b]);
        if (!walks_along(triangles, around[a], element.i, element.j)) std::swap(l, m);
        EdgeElement hinge = element;
        if (l != m) set_hinge(hinge, l, m);
        elements_.push_back(hinge);
      }
    }
  }
  const Eigen::Vector3d size = rest_.rowwise().maxCoeff() - rest_.rowwise().minCoeff();
  const double ratio = lengths / (table.size() * size.norm());
  resolution_ = ratio * ratio;
}

void EdgeMaterialModel::set_hinge(EdgeElement& e, Index l, Index m) const {
  // [v_i - v_j | -(v_l - v_m) | -n] (alpha, beta, c) = v_m - v_j: the common perpendicular of the
  // lines through i, j and through l, m. n, by eq. 4, is the direction of the quadrilateral's area.
  const Eigen::Vector3d edge = rho_of(e, rest_), across = rest_.col(l) - rest_.col(m);
  const Eigen::Vector3d area = -edge.cross(across);
  if (!(area.norm() > kLeastSine * edge.norm() * across.norm())) return;
  Eigen::Matrix3d system;
  system << edge, -across, -area.normalized();
  const Eigen::Vector3d solution = system.inverse() * (rest_.col(m) - rest_.col(e.j));
  if (!((solution.head<2>().array() - 0.5).abs().maxCoeff() < kFarthestFoot)) return;
  e.l = l;
  e.m = m;
  e.alpha = solution[0];
  e.beta = solution[1];
  e.sigma = solution[2];
}

void EdgeMaterialModel::set_field(const Points& field) {
  for (EdgeElement& e : elements_) {
    Eigen::Vector3d sum = field.col(e.i);
    sum += sum.dot(field.col(e.j)) < 0.0 ? Eigen::Vector3d(-field.col(e.j)) : field.col(e.j);
    const double length = sum.norm();
    // Eq. 13; without a direction the material is isotropic.
    const double kappa = length > 0.0 ? std::abs(sum.dot(rho_of(e, rest_))) / (length * e.rho) : 1.0;
    e.kappa = kLeastKappa + (1.0 - kLeastKappa) * kappa;
  }
}

double EdgeMaterialModel::metric_lambda() const {
  return std::max(weights_.lambda, kLeastMetric * resolution_ * weights_.mu);
}

double EdgeMaterialModel::stiffness() const { return std::max(metric_lambda(), weights_.mu); }

BlockMatrix EdgeMaterialModel::matrix() const {
  // The pattern does not depend on weights, so that they may change without an analysis.
  std::vector<std::pair<Edge, double>> entries;
  entries.reserve(6 * elements_.size());
  BlockMatrix matrix;
  matrix.set_zero(1, static_cast<Index>(rest_.cols()), {});
  auto add = [&](Index a, Index b, double value) { entries.push_back({{std::min(a, b), std::max(a, b)}, value}); };
  const double lambda = metric_lambda();
  for (const EdgeElement& e : elements_) {
    const double stretch = e.kappa * lambda, bend = e.kappa * weights_.mu;
    add(e.i, e.j, -stretch);
    matrix.diagonal[e.i] += stretch;
    matrix.diagonal[e.j] += stretch;
    if (e.l < 0) continue;
    const Index points[4] = {e.i, e.j, e.l, e.m};
    const double row[4] = {e.alpha, 1.0 - e.alpha, -e.beta, e.beta - 1.0};
    for (int a = 0; a < 4; ++a) {
      matrix.diagonal[points[a]] += bend * row[a] * row[a];
      for (int b = 0; b < a; ++b) add(points[a], points[b], bend * row[a] * row[b]);
    }
  }
  matrix.sum_off_diagonal(entries);
  return matrix;
}

std::vector<Index> EdgeMaterialModel::folded(const Points& x) const {
  std::vector<Index> found;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const EdgeElement& e = elements_[k];
    if (e.l >= 0 && !(area_of(e, x).norm() > least_normal_[k])) {
      found.push_back(static_cast<Index>(k));
    }
  }
  return found;
}

double EdgeMaterialModel::evaluate(const Points& x, Points& half_gradient) {
  half_gradient.setZero(3, x.cols());
  stretch_ = bend_ = gravity_ = 0.0;
  const double stretch = weights_.lambda * weights_.p_stretch, bend = weights_.mu * weights_.p_bend;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const EdgeElement& e = elements_[k];
    // Stretch: the edge against its rest length along itself (eq. 10).
    const Eigen::Vector3d edge = rho_of(e, x);
    const double length = edge.norm(), longer = length - e.rho;
    stretch_ += e.kappa * longer * longer;
    if (length > 0.0) add_to_ends(e, stretch * e.kappa * longer / length * edge, half_gradient);
    if (e.l < 0) continue;

    // Bend: sigma against its rest length along the normal (eq. 10).
    const Eigen::Vector3d across = x.col(e.l) - x.col(e.m);
    const Eigen::Vector3d area = -edge.cross(across);
    const double size = area.norm();
    const bool folded = !(size > least_normal_[k]);
    auto normal = trial_normals_.col(static_cast<Index>(k));
    normal = folded ? Eigen::Vector3d(normals_.col(static_cast<Index>(k))) : Eigen::Vector3d(area / size);
    const Eigen::Vector3d residual = sigma_of(e, x) - e.sigma * normal;
    bend_ += e.kappa * residual.squaredNorm();
    add_to_hinge(e, bend * e.kappa * residual, half_gradient);
    if (folded) continue;
    // The estimation step leaves out that the normal turns with the points. With its derivative the
    // energy has a gradient, and every accepted step lowers it:
    // <residual, dn> = <tangential part, d((j - i) x (l - m))> / |(j - i) x (l - m)|.
    const Eigen::Vector3d tangential = (bend * e.kappa * e.sigma / size) * (residual - residual.dot(normal) * normal);
    add_to_ends(e, across.cross(tangential), half_gradient);
    const Eigen::Vector3d on_l = tangential.cross(edge);
    half_gradient.col(e.l) += on_l;
    half_gradient.col(e.m) -= on_l;
  }
  if (x == rest_) {
    // Exactly at rest both terms are exactly zero.
    stretch_ = bend_ = 0.0;
    half_gradient.setZero();
  }
  if (!weights_.pull.isZero(0.0)) {
    for (Index p = 0; p < x.cols(); ++p) {
      // Eq. 8 with the sign that makes the shape fall along the pull.
      if (!anchored_[p]) continue;
      gravity_ -= weights_.pull.dot(x.col(p) - rest_.col(p));
      half_gradient.col(p) -= 0.5 * weights_.pull;
    }
  }
  return stretch * stretch_ + bend * bend_ + gravity_;
}

void EdgeMaterialModel::turned_gradient(const Points& from, const Rotations& turns, const Points& x,
                                        Points& half_gradient) const {
  half_gradient.setZero(3, x.cols());
  const double lambda = metric_lambda();
  for (const EdgeElement& e : elements_) {
    const Eigen::Matrix3d turn = 0.5 * (turns.col(e.i) + turns.col(e.j)).reshaped(3, 3);
    add_to_ends(e, lambda * e.kappa * (rho_of(e, x) - turn * rho_of(e, from)), half_gradient);
    if (e.l < 0) continue;
    add_to_hinge(e, weights_.mu * e.kappa * (sigma_of(e, x) - turn * sigma_of(e, from)), half_gradient);
  }
}

}  // namespace pliant::edge_material
