// The energy of ARAP as sums over edges: every edge belongs to the cells of its two ends and, with
// rims, to those of the points across it.
#pragma once

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
  /// Weight of an edge in the cells of its ends.
  double spoke_weight(std::size_t edge) const { return cells_[first_cell_[edge]].weight; }

 private:
  struct Cell {
    Index point;
    double weight;
  };
  /// A row of the cotangent Laplacian of an inner point, as a weighted vector of its cell.
  struct Row {
    Index point;
    double weight;                                  ///< (smoothness size)^2 / area
    std::vector<std::pair<Index, double>> entries;  ///< neighbours and their weights
  };

  void add_rows(const Triangles& triangles, const EdgeTable& table, const Points& cotangents,
                const std::vector<double>& weights, double smoothness);
  /// sum_k w_k |L_k x - Q_k L_k from|^2, its parts and half its gradient.
  std::array<double, 2> residuals(const Points& from, const Rotations& turns, const Points& x,
                                  Points& half_gradient) const;

  Points rest_;
  bool planar_;
  std::vector<Edge> edges_;
  std::vector<double> rest_edges_;       ///< 3 an edge, from its second end to its first
  std::vector<std::size_t> first_cell_;  ///< of each edge in cells_, and the end
  std::vector<Cell> cells_;
  std::vector<Row> rows_;

  Rotations covariances_, rotations_;
  double rigidity_ = 0.0, smoothness_ = 0.0;
};

}  // namespace pliant::arap
