// Adaptive refinement by edge splits. Kho and Garland, section 5.5.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/core/message.h"
#include "pliant/sketch/sketch_model.h"

namespace pliant {
namespace {

constexpr double kMaxStretch = 1.5;  // deformed over original: the paper prints its inverse
constexpr double kMaxAngle = std::numbers::pi - std::numbers::pi / 24;

std::uint64_t key(Index a, Index b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

/// A triangle of the refined mesh, by its vertices; `of`: the input's that it is a part of.
/// spans[c]: of the edge from corner c to the next, its length at rest in the input; half that of
/// the edge whose split made it else, so that every split leaves less to do. (A triangle on a long
/// edge that is not split has another long edge after every split.)
struct Piece {
  std::array<std::uint32_t, 3> corners;
  std::array<double, 3> spans;
  std::uint32_t of;
};

/// Splits in rounds. Whether an edge is split depends on its two ends alone, and these do not move:
/// what a round leaves whole is done, so that all rounds together cost what the input has and what
/// is added.
class Refiner {
 public:
  Refiner(SketchModel& model, std::span<const std::uint32_t> triangles, Index max_added)
      : model_(model), max_added_(max_added), rest_(model.shape->points()) {
    model.refinement.emplace();
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      const std::uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
      const std::array<double, 3> spans{distance(rest_, a, b), distance(rest_, b, c), distance(rest_, c, a)};
      fresh_.push_back({{a, b, c}, spans, static_cast<std::uint32_t>(i / 3)});
    }
    inputs_ = fresh_.size();
  }

  /// False when there would be more than max_added vertices.
  bool run() {
    while (find_edges()) {
      if (static_cast<Index>(parents_.size()) > max_added_) return false;
      add_points();
      if (!split_pieces()) return false;
    }
    done_.insert(done_.end(), fresh_.begin(), fresh_.end());
    write_triangles();
    return true;
  }

 private:
  using Edge = std::array<Index, 2>;

  bool moves(Index p) const {
    return std::any_of(model_.limbs.begin(), model_.limbs.end(), [&](const Limb& limb) { return limb.moves(p); });
  }

  /// The first criterion. The pose is one of a polyline: across a kink of it an edge bends however
  /// short it is, and over a gap of the skinning it stretches. Splitting stops at the length of its
  /// steps, below which there is nothing to come nearer to.
  bool is_stretched(const Edge& edge, double span) const {
    const auto [a, b] = edge;
    const double before = (rest_.col(a) - rest_.col(b)).norm();
    const double after = (model_.world.col(a) - model_.world.col(b)).norm();
    return after > kMaxStretch * before && std::min(before, span) > limb_of(edge).reference().step();
  }

  /// The second, with where the pose takes the middle of the edge.
  bool is_bent(const Edge& edge, const Eigen::Vector3d& middle) const {
    const Eigen::Vector3d u = model_.world.col(edge[0]) - middle, v = model_.world.col(edge[1]) - middle;
    return std::atan2(u.cross(v).norm(), u.dot(v)) < kMaxAngle;
  }

  const Limb& limb_of(const Edge& edge) const { return model_.limb_of(moves(edge[0]) ? edge[0] : edge[1]); }

  Edge points_of(std::uint32_t a, std::uint32_t b) const {
    const Index p = model_.point_of(static_cast<Index>(a)), q = model_.point_of(static_cast<Index>(b));
    return {std::min(p, q), std::max(p, q)};
  }

  /// The edges of fresh pieces that are stretched, each once.
  std::vector<Edge> stretched_edges() const {
    std::unordered_map<std::uint64_t, Index> seen;
    std::vector<Edge> edges;
    for (const Piece& piece : fresh_) {
      for (int c = 0; c < 3; ++c) {
        const Edge edge = points_of(piece.corners[c], piece.corners[(c + 1) % 3]);
        if (edge[0] == edge[1] || (!moves(edge[0]) && !moves(edge[1]))) continue;
        if (seen.try_emplace(key(edge[0], edge[1]), 0).second && is_stretched(edge, piece.spans[c]))
          edges.push_back(edge);
      }
    }
    return edges;
  }

  /// The edges to split in this round: point_of_edge_ gets their new points' ids.
  bool find_edges() {
    const std::vector<Edge> edges = stretched_edges();
    point_of_edge_.clear();
    parents_.clear();
    for (const Limb& limb : model_.limbs) {
      const Points middles = limb.middles(edges, model_.morph);
      for (std::size_t i = 0; i < edges.size(); ++i) {
        if (&limb_of(edges[i]) != &limb || !is_bent(edges[i], middles.col(static_cast<Index>(i)))) continue;
        point_of_edge_.emplace(key(edges[i][0], edges[i][1]), static_cast<Index>(rest_.cols() + parents_.size()));
        parents_.push_back(edges[i]);
      }
    }
    return !parents_.empty();
  }

  void add_points() {
    const Index first = static_cast<Index>(rest_.cols());
    const Index count = static_cast<Index>(parents_.size());
    rest_.conservativeResize(3, first + count);
    model_.world.conservativeResize(3, first + count);
    for (Index i = 0; i < count; ++i) {
      const auto [a, b] = parents_[i];
      rest_.col(first + i) = 0.5 * (rest_.col(a) + rest_.col(b));
      model_.world.col(first + i) = 0.5 * (model_.world.col(a) + model_.world.col(b));
    }
    for (Limb& limb : model_.limbs) {
      limb.add(parents_);
      limb.show(model_.morph, model_.world, first);
    }
  }

  /// The vertex in the middle of an edge, or none. Copies at a seam get one each.
  std::int64_t middle_vertex(std::uint32_t a, std::uint32_t b) {
    const Index p = model_.point_of(static_cast<Index>(a));
    const Index q = model_.point_of(static_cast<Index>(b));
    const auto split = point_of_edge_.find(key(p, q));
    if (split == point_of_edge_.end()) return -1;
    Refinement& refinement = *model_.refinement;
    const Index fresh = model_.shape->input_size() + static_cast<Index>(refinement.parents.size());
    const auto [found, is_new] = vertex_of_edge_.try_emplace(key(static_cast<Index>(a), static_cast<Index>(b)), fresh);
    if (is_new) {
      const Index first = static_cast<Index>(p < q ? a : b);
      refinement.parents.push_back({first, static_cast<Index>(p < q ? b : a)});
      model_.point_of_added.push_back(split->second);
    }
    return found->second;
  }

  bool split_pieces() {
    vertex_of_edge_.clear();
    const std::vector<Piece> pieces = std::exchange(fresh_, {});
    for (const Piece& piece : pieces) {
      split(piece);
      if (static_cast<Index>(model_.refinement->parents.size()) > max_added_) return false;
    }
    return true;
  }

  double distance(const Points& places, std::uint32_t a, std::uint32_t b) const {
    const auto [p, q] = points_of(a, b);
    return (places.col(p) - places.col(q)).norm();
  }

  void split(const Piece& piece) {
    const std::array<std::uint32_t, 3>& corners = piece.corners;
    const std::array<double, 3>& spans = piece.spans;
    const std::uint32_t of = piece.of;
    std::int64_t middle[3];
    int count = 0;
    double half = 0.0;  // of the longest that is split
    for (int c = 0; c < 3; ++c) {
      middle[c] = middle_vertex(corners[c], corners[(c + 1) % 3]);
      if (middle[c] < 0) continue;
      ++count;
      half = std::max(half, 0.5 * spans[c]);
    }
    if (count == 0) return done_.push_back(piece);
    // Turned so that the first edge is split and, of two, the last is not.
    int turn = 0;
    while (count < 3 && !(middle[turn] >= 0 && middle[(turn + 2) % 3] < 0)) ++turn;
    const auto corner = [&](int k) { return corners[(turn + k) % 3]; };
    const auto between = [&](int k) { return static_cast<std::uint32_t>(middle[(turn + k) % 3]); };
    const auto span = [&](int k) { return spans[(turn + k) % 3]; };
    const std::uint32_t a = corner(0), b = corner(1), c = corner(2), ab = between(0), bc = between(1), ca = between(2);
    const double s = 0.5 * span(0), t = 0.5 * span(1), u = 0.5 * span(2);
    if (count == 1) {
      fresh_.push_back({{a, ab, c}, {s, half, span(2)}, of});
      fresh_.push_back({{ab, b, c}, {s, span(1), half}, of});
    } else if (count == 3) {
      fresh_.push_back({{a, ab, ca}, {s, half, u}, of});
      fresh_.push_back({{ab, b, bc}, {s, t, half}, of});
      fresh_.push_back({{ca, bc, c}, {half, t, u}, of});
      fresh_.push_back({{ab, bc, ca}, {half, half, half}, of});
    } else {
      fresh_.push_back({{ab, b, bc}, {s, t, half}, of});
      if (distance(model_.world, a, bc) <= distance(model_.world, ab, c)) {
        fresh_.push_back({{a, ab, bc}, {s, half, half}, of});
        fresh_.push_back({{a, bc, c}, {half, t, span(2)}, of});
      } else {
        fresh_.push_back({{a, ab, c}, {s, half, span(2)}, of});
        fresh_.push_back({{ab, bc, c}, {half, t, half}, of});
      }
    }
  }

  /// In the order of the input's triangles.
  void write_triangles() {
    std::vector<std::size_t> next(inputs_ + 1, 0);
    for (const Piece& piece : done_) ++next[piece.of + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    Refinement& refinement = *model_.refinement;
    refinement.triangles.resize(3 * done_.size());
    refinement.triangle_parents.resize(done_.size());
    for (const Piece& piece : done_) {
      const std::size_t place = next[piece.of]++;
      std::copy(piece.corners.begin(), piece.corners.end(), refinement.triangles.begin() + 3 * place);
      refinement.triangle_parents[place] = piece.of;
    }
  }

  SketchModel& model_;
  Index max_added_;
  Points rest_;
  std::size_t inputs_ = 0;
  std::vector<Piece> fresh_, done_;  ///< of the last round, and those that stay
  std::vector<Edge> parents_;        ///< of the points added in this round
  std::unordered_map<std::uint64_t, Index> point_of_edge_, vertex_of_edge_;
};

}  // namespace

Status Sketch::refine(std::span<const std::uint32_t> triangles, Index max_added) {
  if (triangles.size() % 3 != 0) {
    return {ErrorCode::invalid_shape,
            message({"triangles has length ", triangles.size(), "; expected a multiple of 3"})};
  }
  const Index vertices = impl_->shape->input_size();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] >= static_cast<std::uint32_t>(vertices)) {
      return {ErrorCode::invalid_shape,
              message({"triangles[", i, "] is ", triangles[i], "; expected a vertex id below ", vertices})};
    }
  }
  unrefine();
  if (!Refiner(*impl_, triangles, max_added).run()) {
    unrefine();
    return {ErrorCode::too_large,
            message({"refining would add more than ", max_added, " vertices; expected a pose that stretches less"})};
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
