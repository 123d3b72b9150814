// Edits and readings that tests of every method share.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "pliant/solve/run.h"
#include "support/shapes.h"

namespace pliant::test {

/// Vertices of a mesh that a predicate picks.
std::vector<Index> pick(const Mesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& wanted);

/// Fixes the lowest tenth (by z) and makes the highest tenth a handle; returns its id.
HandleId fix_bottom_grab_top(Deformer& deformer, const Mesh& mesh);

/// A turn about an axis through a point, and a translation after it.
Motion turn(double degrees, const Eigen::Vector3d& axis, const Eigen::Vector3d& about,
            const Eigen::Vector3d& translation = Eigen::Vector3d::Zero());

/// Runs to the end and fails the test on an error.
StepReport settle(Deformer& deformer, int max_iterations = 200, double tolerance = 1e-9);

/// Largest distance between two sets of points.
double distance(const Points& a, const Points& b);

}  // namespace pliant::test
