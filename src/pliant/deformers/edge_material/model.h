// The energy of material-aware edges: stretch (rho) and bend (sigma) of every edge, eq. 4-9.
#pragma once

#include <vector>

#include "pliant/geometry/shape.h"
#include "pliant/solve/local_model.h"

namespace pliant::edge_material {

/// An edge and, where two triangles share it, the line between the points across it. An edge of k
/// triangles appears once for every pair of them.
struct EdgeElement {
  Index i, j;
  Index l = -1, m = -1;  ///< -1: no bending term. (j - i) x (l - m) has the direction of eq. 4
  double alpha = 0.5, beta = 0.5;
  double rho = 0.0;    ///< length at rest
  double sigma = 0.0;  ///< distance of p from q at rest, positive where p - q points along the normal
  double kappa = 1.0;  ///< eps + (1 - eps) kappa of eq. 13
};

/// Weights of the terms: the constant matrix knows lambda and mu, the energy lambda p_stretch and
/// mu p_bend. Both rest where eq. 10-12 and 15 rest, up to the turn of normals (see the source).
struct MaterialWeights {
  double lambda = 1.0, mu = 1.0;
  double p_stretch = 1.0, p_bend = 1.0;
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();  ///< on every anchored point
};

class EdgeMaterialModel final : public LocalModel {
 public:
  explicit EdgeMaterialModel(const Shape& shape);

  void set_weights(const MaterialWeights& weights) { weights_ = weights; }
  /// kappa of every element from directions at the points (3 x p, unit or zero, sign without
  /// meaning).
  void set_field(const Points& field);

  BlockMatrix matrix() const override;
  double evaluate(const Points& x, Points& half_gradient) override;
  void accept() override { normals_.swap(trial_normals_); }
  void turned_gradient(const Points& from, const Rotations& turns, const Points& x,
                       Points& half_gradient) const override;
  void set_anchored(const std::vector<bool>& anchored) override { anchored_ = anchored; }
  double stiffness() const override;

  /// (h / L)^2: mean edge length over the diagonal, squared.
  double resolution() const { return resolution_; }
  const std::vector<EdgeElement>& elements() const { return elements_; }
  const MaterialWeights& weights() const { return weights_; }
  /// Elements that are folded at x: they keep the normal they had before.
  std::vector<Index> folded(const Points& x) const;
  Eigen::Vector3d normal(Index element) const { return normals_.col(element); }
  void set_normal(Index element, const Eigen::Vector3d& normal) { normals_.col(element) = normal; }
  /// Whether gravity acts on a point.
  bool anchored(Index point) const { return anchored_[point]; }
  /// Unweighted terms of the last evaluation.
  double stretch() const { return stretch_; }
  double bend() const { return bend_; }
  double gravity() const { return gravity_; }

 private:
  void add_elements(const Triangles& triangles);
  void set_hinge(EdgeElement& element, Index l, Index m) const;
  double metric_lambda() const;

  Points rest_;
  std::vector<EdgeElement> elements_;
  std::vector<double> least_normal_;  ///< (j - i) x (l - m) must be at least this long
  std::vector<bool> anchored_;
  double resolution_ = 1.0;
  MaterialWeights weights_;
  Points normals_, trial_normals_;  ///< of the elements: where the deformation stands, and on trial
  double stretch_ = 0.0, bend_ = 0.0, gravity_ = 0.0;
};

}  // namespace pliant::edge_material
