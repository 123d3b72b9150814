// E_con (eq. 8) over the free nodes: C x against targets, and C'C, which makes its cost in a step
// independent of how many points a handle has. Unknowns are laid out as in energy.h.
#pragma once

#include <vector>

#include "pliant/deformers/embedded_graph/graph.h"
#include "pliant/linalg/block_matrix.h"

namespace pliant::embedded {

using Vector = Eigen::VectorXd;

class GraphConstraints {
 public:
  /// points: scaled rest positions of the constrained points, 3 x c, with their influences. nodes:
  /// scaled positions of all nodes; free_of_node: -1 for frozen ones. edges: between free nodes,
  /// sorted. Targets are at rest.
  void set_up(const Points& points, const Influences& influences, const Points& nodes,
              const std::vector<Index>& free_of_node, Index free_nodes, const std::vector<Edge>& edges);
  /// Displacements from rest that the points should have, 3 x c.
  void set_targets(const Points& displacements) { targets_ = displacements; }

  /// product += C' v, where v is `value` at the given points and 0 at the others.
  void add_common(const std::vector<Index>& points, const Eigen::Vector3d& value, Vector& product) const;
  /// C x - targets, 3 x c.
  Points residuals(const Vector& x) const;
  /// Adds w C'C to a matrix over all free nodes and the edges of set_up.
  void add_to(BlockMatrix& matrix, double w) const;

  /// Moves to x: residuals and gradient from scratch. Returns |C x - targets|^2.
  double evaluate(const Vector& x);
  /// Of the last `evaluate`, 3 x c.
  const Points& evaluated() const { return residuals_; }
  /// C' (C x - targets), also after `advance`.
  const Vector& gradient() const { return gradient_; }

  /// |C (x + alpha d) - targets|^2 = that at x + alpha (slope + alpha curvature).
  struct Course {
    double slope = 0.0, curvature = 0.0;
  };
  Course along(const Vector& d);
  /// Moves on by alpha times the direction last given to `along`.
  void advance(double alpha) { gradient_ += alpha * along_; }

 private:
  /// One influence of a point: (w (v - g), w) on a free node.
  struct Influence {
    Index node;
    Eigen::Vector4d coefficients;
  };
  /// One 4 x 4 block of C'C; k >= j. edge: -1 on the diagonal.
  struct Block {
    Index j, k, edge;
    Eigen::Matrix4d block;  ///< rows of k, columns of j
    Eigen::Matrix4d transposed;
  };

  Index rows() const { return 4 * free_nodes_; }
  void gather_blocks(const Points& points, const Points& free_positions, const std::vector<Edge>& edges);
  void apply_blocks(const Vector& d, Vector& product) const;

  Index free_nodes_ = 0;
  std::vector<Influence> influences_;
  std::vector<std::size_t> start_;  ///< of each point in influences_, and the end
  Points targets_, residuals_;
  std::vector<Block> blocks_;
  Vector gradient_, along_;
  Vector by_node_, sum_by_node_;  ///< for `evaluate`
};

}  // namespace pliant::embedded
