#include "support/edits.h"

#include <numbers>

#include <doctest/doctest.h>

namespace pliant::test {

std::vector<Index> pick(const Mesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& wanted) {
  std::vector<Index> picked;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (wanted(mesh.vertex(v))) picked.push_back(v);
  }
  return picked;
}

HandleId fix_bottom_grab_top(Deformer& deformer, const Mesh& mesh) {
  double low = mesh.vertex(0).z(), high = low;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    low = std::min(low, mesh.vertex(v).z());
    high = std::max(high, mesh.vertex(v).z());
  }
  const double tenth = 0.1 * (high - low);
  REQUIRE(deformer.set_fixed(pick(mesh, [&](const auto& p) { return p.z() <= low + tenth; })).ok());
  const auto handle = deformer.add_handle(pick(mesh, [&](const auto& p) { return p.z() >= high - tenth; }));
  REQUIRE(handle.ok());
  return *handle;
}

Motion turn(double degrees, const Eigen::Vector3d& axis, const Eigen::Vector3d& about,
            const Eigen::Vector3d& translation) {
  Motion motion;
  motion.angle = degrees * std::numbers::pi / 180.0;
  motion.axis = axis;
  motion.about = about;
  motion.translation = translation;
  return motion;
}

StepReport settle(Deformer& deformer, int max_iterations, double tolerance) {
  const auto report = run(deformer, {max_iterations, tolerance});
  REQUIRE(report.ok());
  return *report;
}

double distance(const Points& a, const Points& b) { return (a - b).colwise().norm().maxCoeff(); }

}  // namespace pliant::test
