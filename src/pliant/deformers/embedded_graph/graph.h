// The deformation graph at rest: nodes, the influence of nodes on points, and the edges that follow
// (Sumner 2007, section 3).
#pragma once

#include <vector>

#include "pliant/core/status.h"
#include "pliant/deformers/embedded_graph/options.h"
#include "pliant/geometry/shape.h"
#include "pliant/linalg/block_matrix.h"
#include "pliant/solve/carry.h"

namespace pliant {

/// What a cut makes of a node or point: 0 free, 1 side a, 2 side b.
using CutSides = std::vector<unsigned char>;

struct DeformationGraph {
  Points nodes;                                      ///< g_j, 3 x m, input coordinates
  Influences influences;                             ///< of nodes on the points of the shape (eq. 4)
  std::vector<Edge> edges;                           ///< nodes that influence a common point, j < k, sorted
  std::vector<Index> elimination_order;              ///< of the nodes, for the solver's factorisations
  double length_unit = 1.0;                          ///< mean edge length: the energies are taken in this unit
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< centre of the scene, for accuracy only
  std::vector<CutSides> node_sides;                  ///< one list a cut
  std::vector<CutSides> point_sides;                 ///< of the points of the shape, one list a cut

  Index size() const { return static_cast<Index>(nodes.cols()); }
  /// Input coordinates -> the solver's: centred, in length units.
  Points scaled(const Points& points) const { return (points.colwise() - origin) / length_unit; }
};

/// Chooses nodes as the options say. The options are valid for the shape.
Result<Points> place_nodes(const Shape& shape, const EmbeddedGraphOptions& options);

/// Influences, edges and unit for given nodes (3 x m, m >= 1).
DeformationGraph build_graph(const Shape& shape, Points nodes, const EmbeddedGraphOptions& options);

/// Influences of a graph on any other points (3 x q); across its cuts a point is on the side of the
/// nearest point of the shape.
Influences compute_influences(const Shape& shape, const DeformationGraph& graph, const Points& points);

}  // namespace pliant
