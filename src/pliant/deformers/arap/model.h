// The energy of ARAP as sums over edges: every edge belongs to the cells of its two ends and, with
// rims, to those of the points across it.
#pragma once

#include <array>
#include <vector>

#include "pliant/deformers/arap/options.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/solve/local_model.h"

namespace pliant::arap {

class ArapModel final : public LocalModel {
 public:
  ArapModel(const Shape& shape, const ArapOptions& options);

  BlockMatrix matrix() const override;
  double evaluate(const Points& x, Points& half_gradient) override;
  void turned_gradient(const Points& from, const Rotations& turns, const Points& x,
                       Points& half_gradient) const override;
  /// Measured: 3 saves a third of the iterations, 2 and 4.5 less. Smooth rows are taken as they
  /// are.
  double slack() const override { return rows_.empty() ? 3.0 : 1.0; }
  double stiffness() const override { return 1.0; }

  /// Of the last evaluation: its parts, E = rigidity + smoothness^2 ..., see ArapOptions.
  double rigidity() const { return rigidity_; }
  double smoothness() const { return smoothness_; }
  const Rotations& rotations() const { return rotations_; }

  const std::vector<Edge>& edges() const { return edges_; }
  /// Weight of each edge in the cells of its ends.
  std::vector<double> spoke_weights() const;

 private:
  /// An edge and the four points in whose cells it lies: its ends and, with rims, those across it
  /// (an end with weight 0 where there is none). Edges of more than two triangles go on in a second
  /// record, where their ends weigh 0. One cache line.
  struct Spoke {
    std::array<Index, 4> cells;
    std::array<double, 3> weights;  ///< of both ends, and of either point across
    std::array<double, 3> rest;     ///< from the second end to the first
    double weight_of(int cell) const { return weights[cell < 2 ? 0 : cell - 1]; }
  };
  /// A row of the cotangent Laplacian of an inner point, as a weighted vector of its cell.
  struct Row {
    Index point;
    double weight;                                  ///< (smoothness size)^2 / area
    std::vector<std::pair<Index, double>> entries;  ///< neighbours and their weights
  };

  void add_rows(const Triangles& triangles, const EdgeTable& table, const Points& cotangents,
                const std::vector<double>& weights, double smoothness);
  /// Calls f(spoke, edge) with the edge each spoke belongs to.
  template <class F>
  void for_spokes(F f) const;
  /// sum_k w_k |L_k x - Q_k L_k from|^2, its parts and half its gradient.
  std::array<double, 2> residuals(const Points& from, const Rotations& turns, const Points& x,
                                  Points& half_gradient) const;
  /// The part of the edges; gradient is added to.
  double edge_residuals(const Points& from, const Rotations& turns, const Points& x, Points& half_gradient) const;

  Points rest_;
  bool planar_;
  std::vector<Edge> edges_;
  std::vector<Spoke> spokes_;  ///< in the order of edges_
  int cells_a_spoke_;          ///< 2 or, with rims, 4
  std::vector<Row> rows_;

  Rotations covariances_, rotations_;
  double rigidity_ = 0.0, smoothness_ = 0.0;
};

}  // namespace pliant::arap
