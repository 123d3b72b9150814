#include "pliant/deformers/rigid_cells/pieces.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "pliant/core/disjoint_sets.h"
#include "pliant/geometry/closest_rotation.h"

namespace pliant::cells {

std::vector<std::vector<Index>> small_pieces(const Shape& shape, double size) {
  if (shape.report().components <= 1) return {};
  const Index count = static_cast<Index>(shape.points().cols());
  DisjointSets sets(count);
  for (const auto& corners : shape.triangles().colwise()) {
    sets.join(corners[0], corners[1]);
    sets.join(corners[0], corners[2]);
  }
  const auto numbered = sets.numbered();
  std::vector<Eigen::AlignedBox3d> boxes(numbered.count);
  std::vector<std::vector<Index>> pieces(numbered.count);
  for (Index p = 0; p < count; ++p) {
    boxes[numbered.of[p]].extend(shape.points().col(p));
    pieces[numbered.of[p]].push_back(p);
  }
  for (Index k = 0; k < numbered.count; ++k) {
    if (boxes[k].diagonal().norm() > size) pieces[k].clear();
  }
  std::erase_if(pieces, [](const std::vector<Index>& piece) { return piece.size() < 2; });
  return pieces;
}

void keep_rigid(const std::vector<Index>& piece, const std::vector<bool>& held, const Points& rest, Points& carried) {
  const auto still = [&](Index p) { return carried.col(p) == rest.col(p); };
  if (std::all_of(piece.begin(), piece.end(), still)) return;
  RigidFit all, rest_of_way;
  for (const Index p : piece) all.add(rest.col(p), carried.col(p));
  const RigidMotion motion = all.motion();
  for (const Index p : piece) {
    const Eigen::Vector3d moved = motion.rotation * rest.col(p) + motion.translation;
    if (held[p]) rest_of_way.add(moved, carried.col(p));
    carried.col(p) = moved;
  }
  const RigidMotion last = rest_of_way.motion();
  for (const Index p : piece) carried.col(p) = last.rotation * carried.col(p) + last.translation;
}

}  // namespace pliant::cells
