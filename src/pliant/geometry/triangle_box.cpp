#include "pliant/geometry/triangle_box.h"

#include <Eigen/Geometry>

namespace pliant {
namespace {

/// Whether the projections on an axis are apart; an axis of no length separates nothing.
bool apart(const Eigen::Vector3d& axis, const Eigen::Matrix3d& corners, const Eigen::Vector3d& half) {
  const Eigen::RowVector3d along = axis.transpose() * corners;
  const double reach = axis.cwiseAbs().dot(half);
  return along.minCoeff() > reach || along.maxCoeff() < -reach;
}

}  // namespace

bool triangle_meets_box(const Eigen::Matrix3d& corners, const CenteredBox& box) {
  const Eigen::Matrix3d local = corners.colwise() - box.center;
  if ((local.rowwise().minCoeff().array() > box.half.array()).any()) return false;
  if ((local.rowwise().maxCoeff().array() < -box.half.array()).any()) return false;
  const Eigen::Vector3d edges[3] = {local.col(1) - local.col(0), local.col(2) - local.col(1),
                                    local.col(0) - local.col(2)};
  if (apart(edges[0].cross(edges[1]), local, box.half)) return false;
  for (const Eigen::Vector3d& edge : edges) {
    for (int axis = 0; axis < 3; ++axis) {
      if (apart(Eigen::Vector3d::Unit(axis).cross(edge), local, box.half)) return false;
    }
  }
  return true;
}

}  // namespace pliant
