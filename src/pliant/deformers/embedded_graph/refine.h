// Refinement of a deformation graph where its terms are high (Sumner 2007, future work).
#pragma once

#include "pliant/deformers/embedded_graph/graph.h"
#include "pliant/deformers/embedded_graph/pose.h"
#include "pliant/deformers/embedded_graph/solver.h"

namespace pliant::embedded {

/// Points of the shape to become nodes, 3 x at most max_nodes: near nodes whose energy stands out,
/// each in turn the farthest from all nodes so far.
Points nodes_to_add(const Shape& shape, const DeformationGraph& graph, const GraphSolver& solver, Index max_nodes);

/// The pose of a refined graph: its first nodes keep theirs, the others take the blended motion of
/// the old graph at their place.
Pose inherited_pose(const Shape& shape, const DeformationGraph& old_graph, const Pose& old_pose,
                    const DeformationGraph& refined);

}  // namespace pliant::embedded
