// The energy of the embedded deformation graph (Sumner 2007, eq. 5-9) over its free nodes, its
// derivatives, and its exact course along a direction.
//
// Everything happens in the solver's frame (centred, one length unit = one mean edge) and in
// displacements from rest: node j has U_j = R_j - I and t_j, so that rest is exactly zero. E_reg
// and E_con are quadratic and alike for x, y and z; only E_rot, inside one node, couples them. So
// the unknowns are three vectors of four numbers a free node: x[a][j] = (row a of U_j, t_j[a]).
#pragma once

#include <array>
#include <vector>

#include "pliant/deformers/embedded_graph/constraints.h"
#include "pliant/deformers/embedded_graph/graph.h"
#include "pliant/linalg/block_matrix.h"

namespace pliant::embedded {

struct Weights {
  double rotation = 1.0;
  double regularization = 10.0;
  double constraint = 100.0;
};

/// Unweighted terms.
struct Terms {
  double rotation = 0.0;
  double regularization = 0.0;
  double constraint = 0.0;
  double barrier = 0.0;  ///< of barrier.h, weighted as rotation; GraphEnergy leaves it 0

  double total(const Weights& w) const {
    return w.rotation * (rotation + barrier) + w.regularization * regularization + w.constraint * constraint;
  }
};

/// F(x + alpha d) = sum of c[i] alpha^i: E_rot is quartic along a line, the others quadratic.
struct Quartic {
  std::array<double, 5> c{};
  double value(double alpha) const { return c[0] + alpha * (c[1] + alpha * (c[2] + alpha * (c[3] + alpha * c[4]))); }
  double slope(double alpha) const { return c[1] + alpha * (2.0 * c[2] + alpha * (3.0 * c[3] + alpha * 4.0 * c[4])); }
  /// Smallest alpha > 0 at which the function stops falling; c[1] < 0. 0 where it never falls.
  double first_minimum() const;
};

class GraphEnergy {
 public:
  /// constrained: scaled rest positions of the constrained points with their influences.
  /// frozen: nodes that stay at rest (they leave the unknowns). Keeps references to nothing.
  void set_up(const DeformationGraph& graph, const std::vector<bool>& frozen, const Points& constrained,
              const Influences& influences, const Weights& weights);
  GraphConstraints& constraints() { return constraints_; }
  const GraphConstraints& constraints() const { return constraints_; }

  Index free_nodes() const { return static_cast<Index>(node_of_free_.size()); }
  Index unknowns() const { return 12 * free_nodes(); }
  Index rows() const { return 4 * free_nodes(); }  ///< length of one of the three parts of x
  const std::vector<Index>& node_of_free() const { return node_of_free_; }
  const std::vector<Index>& free_of_node() const { return free_of_node_; }  ///< -1: frozen
  const std::vector<Edge>& free_edges() const { return free_edges_; }
  const Weights& weights() const { return weights_; }

  /// Moves to x: everything from scratch, exactly.
  void evaluate(const Vector& x);
  /// Moves on along the direction last given to `along`; E_con is updated where that keeps its
  /// digits, else evaluated anew.
  void advance(double alpha, const Vector& x);
  /// Takes the last `advance` back; `terms` are those from before it.
  void retreat(double alpha, const Terms& terms);
  const Terms& terms() const { return terms_; }
  double total() const { return terms_.total(weights_); }
  /// Terms of every node of the graph: its rotation, and its directed edges' regularisation.
  void node_terms(const Vector& x, std::vector<double>& rotation, std::vector<double>& regularization) const;
  /// Their weighted sums, one a node.
  std::vector<double> node_energies(const Vector& x) const;

  /// Half the gradient of F at the current x.
  void half_gradient(const Vector& x, Vector& gradient) const;
  /// The course of F from the current x along d.
  Quartic along(const Vector& x, const Vector& d);

  /// The constant part of half the Hessian, one 4 x 4 block a free node or edge, the same for x, y
  /// and z: w_reg A'A + w_con C'C.
  void constant_matrix(BlockMatrix& matrix) const;
  /// J'J of Gauss-Newton: 12 x 12 blocks, node by node, (a, entry) -> 4 a + entry. constant: of
  /// `constant_matrix`. Lays `matrix` out anew unless it is laid out over the present free nodes and edges.
  void gauss_newton_matrix(const Vector& x, const BlockMatrix& constant, BlockMatrix& matrix) const;

  // The four numbers of row a of free node j.
  double* entry(Vector& x, int a, Index j) const { return x.data() + a * rows() + 4 * j; }
  const double* entry(const Vector& x, int a, Index j) const { return x.data() + a * rows() + 4 * j; }
  Eigen::Matrix3d displacement_gradient(const Vector& x, Index free_node) const;  ///< U_j
  Eigen::Vector3d translation(const Vector& x, Index free_node) const;            ///< t_j
  void set_displacement_gradient(Vector& x, Index free_node, const Eigen::Matrix3d& u) const;
  void set_translation(Vector& x, Index free_node, const Eigen::Vector3d& t) const;

 private:
  /// Both directed residuals of an undirected edge; -1 for a frozen end.
  struct FreeEdge {
    Index j, k;
    Eigen::Vector3d d;  ///< g_k - g_j
  };
  void regularization_residuals(const Vector& x, Points& reg) const;
  /// Calls f(j, k, counts) for the free nodes two by two; of an odd last one, which comes as both,
  /// the second does not count.
  template <class F>
  void for_node_pairs(F f) const;
  double rotation_terms(const Vector& x) const;  ///< eq. 6

  Weights weights_;
  std::vector<Index> node_of_free_, free_of_node_;
  Index all_nodes_ = 0;
  std::vector<FreeEdge> edges_;
  std::vector<Edge> free_edges_;        ///< those of edges_ with two free ends
  std::vector<Index> free_edge_index_;  ///< of each of edges_, or -1
  GraphConstraints constraints_;
  GraphConstraints::Course con_along_;
  Points reg_, reg_along_;  ///< residuals of eq. 7, two columns an edge; their change along d
  Terms terms_;
  double evaluated_constraint_ = 0.0;  ///< when it was last evaluated
};

}  // namespace pliant::embedded
