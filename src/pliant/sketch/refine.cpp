// Adaptive refinement by edge splits. Kho and Garland, section 5.5.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/sketch/sketch_impl.h"

namespace pliant {
namespace {

constexpr double kMaxStretch = 1.5;  // deformed over original: the paper prints its inverse
constexpr double kMaxAngle = std::numbers::pi - std::numbers::pi / 24;

std::uint64_t key(Index a, Index b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

class Refiner {
 public:
  Refiner(SketchImpl& impl, std::span<const std::uint32_t> triangles, Index max_added)
      : impl_(impl), max_added_(max_added) {
    impl.refinement.emplace();
    Refinement& refinement = *impl.refinement;
    refinement.triangles.assign(triangles.begin(), triangles.end());
    for (std::uint32_t t = 0; t < triangles.size() / 3; ++t) {
      refinement.triangle_parents.push_back(t);
    }
    rest_ = impl.shape->points();
  }

  /// False when there would be more than max_added vertices.
  bool run() {
    while (find_edges()) {
      add_points();
      if (!split_triangles()) return false;
    }
    return true;
  }

 private:
  bool moves(Index p) const {
    return std::any_of(impl_.limbs.begin(), impl_.limbs.end(), [&](const Limb& limb) { return limb.moves(p); });
  }

  /// Both criteria.
  bool wants_split(Index a, Index b) const {
    if (!moves(a) && !moves(b)) return false;
    const double before = (rest_.col(a) - rest_.col(b)).norm();
    const Eigen::Vector3d p = impl_.world.col(a), q = impl_.world.col(b);
    if (!((p - q).norm() > kMaxStretch * before)) return false;
    const Limb& limb = impl_.limb_of(moves(a) ? a : b);
    const Eigen::Vector3d middle = limb.middle(a, b, impl_.morph);
    const Eigen::Vector3d u = p - middle, v = q - middle;
    return std::atan2(u.cross(v).norm(), u.dot(v)) < kMaxAngle;
  }

  /// The edges to split in this round: point_of_edge_ gets their new points' ids.
  bool find_edges() {
    std::unordered_map<std::uint64_t, Index> seen;
    point_of_edge_.clear();
    parents_.clear();
    const std::vector<std::uint32_t>& corners = impl_.refinement->triangles;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      const Index a = impl_.point_of(static_cast<Index>(corners[i]));
      const Index b = impl_.point_of(static_cast<Index>(corners[next]));
      if (a == b || (!moves(a) && !moves(b))) continue;
      if (!seen.try_emplace(key(a, b), 0).second || !wants_split(a, b)) continue;
      point_of_edge_.emplace(key(a, b), static_cast<Index>(rest_.cols() + parents_.size()));
      parents_.push_back({std::min(a, b), std::max(a, b)});
    }
    return !parents_.empty();
  }

  void add_points() {
    const Index first = static_cast<Index>(rest_.cols());
    const Index count = static_cast<Index>(parents_.size());
    rest_.conservativeResize(3, first + count);
    impl_.world.conservativeResize(3, first + count);
    for (Index i = 0; i < count; ++i) {
      const auto [a, b] = parents_[i];
      rest_.col(first + i) = 0.5 * (rest_.col(a) + rest_.col(b));
      impl_.world.col(first + i) = 0.5 * (impl_.world.col(a) + impl_.world.col(b));
    }
    for (Limb& limb : impl_.limbs) {
      limb.add(parents_);
      limb.show(impl_.morph, impl_.world);
    }
  }

  /// The vertex in the middle of an edge, or none. Copies at a seam get one each.
  std::int64_t middle_vertex(std::uint32_t a, std::uint32_t b) {
    const Index p = impl_.point_of(static_cast<Index>(a));
    const Index q = impl_.point_of(static_cast<Index>(b));
    const auto split = point_of_edge_.find(key(p, q));
    if (split == point_of_edge_.end()) return -1;
    Refinement& refinement = *impl_.refinement;
    const Index fresh = impl_.shape->input_size() + static_cast<Index>(refinement.parents.size());
    const auto [found, is_new] = vertex_of_edge_.try_emplace(key(static_cast<Index>(a), static_cast<Index>(b)), fresh);
    if (is_new) {
      const Index first = static_cast<Index>(p < q ? a : b);
      refinement.parents.push_back({first, static_cast<Index>(p < q ? b : a)});
      impl_.point_of_added.push_back(split->second);
    }
    return found->second;
  }

  bool split_triangles() {
    Refinement& refinement = *impl_.refinement;
    vertex_of_edge_.clear();
    const std::vector<std::uint32_t> before = std::move(refinement.triangles);
    const std::vector<std::uint32_t> parents = std::move(refinement.triangle_parents);
    refinement.triangles.clear();
    refinement.triangle_parents.clear();
    for (std::size_t t = 0; t < parents.size(); ++t) {
      split(&before[3 * t]);
      refinement.triangle_parents.resize(refinement.triangles.size() / 3, parents[t]);
      if (static_cast<Index>(refinement.parents.size()) > max_added_) return false;
    }
    return true;
  }

  void emit(std::int64_t a, std::int64_t b, std::int64_t c) {
    for (const std::int64_t corner : {a, b, c}) {
      impl_.refinement->triangles.push_back(static_cast<std::uint32_t>(corner));
    }
  }

  double distance(std::int64_t a, std::int64_t b) const {
    return (impl_.world.col(impl_.point_of(static_cast<Index>(a))) -
            impl_.world.col(impl_.point_of(static_cast<Index>(b))))
        .norm();
  }

  void split(const std::uint32_t* corners) {
    std::int64_t middle[3];
    int count = 0;
    for (int c = 0; c < 3; ++c) {
      middle[c] = middle_vertex(corners[c], corners[(c + 1) % 3]);
      count += middle[c] >= 0;
    }
    // Turned so that the first edge is split and, of two, the last is not.
    int turn = 0;
    while (count > 0 && count < 3 && !(middle[turn] >= 0 && middle[(turn + 2) % 3] < 0)) {
      ++turn;
    }
    const std::int64_t a = corners[turn], b = corners[(turn + 1) % 3], c = corners[(turn + 2) % 3];
    const std::int64_t ab = middle[turn], bc = middle[(turn + 1) % 3], ca = middle[(turn + 2) % 3];
    if (count == 0) {
      emit(a, b, c);
    } else if (count == 1) {
      emit(a, ab, c);
      emit(ab, b, c);
    } else if (count == 3) {
      emit(a, ab, ca);
      emit(ab, b, bc);
      emit(ca, bc, c);
      emit(ab, bc, ca);
    } else {
      emit(ab, b, bc);
      const bool from_a = distance(a, bc) <= distance(ab, c);
      emit(a, ab, from_a ? bc : c);
      emit(from_a ? a : ab, bc, c);
    }
  }

  SketchImpl& impl_;
  Index max_added_;
  Points rest_;
  std::vector<std::array<Index, 2>> parents_;  ///< of the points added in this round
  std::unordered_map<std::uint64_t, Index> point_of_edge_, vertex_of_edge_;
};

}  // namespace

Status Sketch::refine(std::span<const std::uint32_t> triangles, Index max_added) {
  if (triangles.size() % 3 != 0) {
    return {ErrorCode::invalid_shape,
            "triangles has length " + std::to_string(triangles.size()) + "; expected a multiple of 3"};
  }
  const Index vertices = impl_->shape->input_size();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] >= static_cast<std::uint32_t>(vertices)) {
      return {ErrorCode::invalid_shape, "triangles[" + std::to_string(i) + "] is " + std::to_string(triangles[i]) +
                                            "; expected a vertex id below " + std::to_string(vertices)};
    }
  }
  unrefine();
  if (!Refiner(*impl_, triangles, max_added).run()) {
    unrefine();
    return {ErrorCode::too_large, "refining would add more than " + std::to_string(max_added) +
                                      " vertices; expected a pose that stretches less"};
  }
  return {};
}

void Sketch::unrefine() {
  if (!impl_->refinement) return;
  impl_->refinement.reset();
  impl_->point_of_added.clear();
  for (Limb& limb : impl_->limbs) limb.drop_added();
  impl_->world.conservativeResize(3, impl_->shape->points().cols());
}

}  // namespace pliant
