// A mesh that loses points by collapses of edges, the cheapest first: what `simplify` is made of.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "pliant/core/types.h"
#include "pliant/geometry/quadric.h"

namespace pliant {

/// A mesh losing points. Points are ranks of the canonical order: every choice follows from the
/// shape.
class Collapser {
 public:
  Collapser(Points points, Triangles triangles, double max_aspect_ratio);

  /// Removes points, cheapest first, until `target` are left.
  void run(Index target);
  bool is_left(Index p) const { return alive_[p] != 0; }

 private:
  static constexpr Index kNothing = -1;

  /// `point` goes to `onto`, or, where it has no triangles left, vanishes (onto nothing).
  struct Collapse {
    double cost;
    Index point;
    Index onto;
    Index stamp;  ///< the point's when this was computed

    bool operator>(const Collapse& other) const {
      return std::tie(cost, point, onto) > std::tie(other.cost, other.point, other.onto);
    }
  };

  struct Neighbour {
    Index point;
    int triangles;  ///< that share the edge
  };
  using Ring = std::vector<Neighbour>;

  void collect_ring(Index p, Ring& ring);
  bool is_in_ring(Index p) const { return ring_mark_[p] == ring_number_; }
  bool contains(Index t, Index p) const { return (triangles_.col(t).array() == p).any(); }
  Eigen::Matrix3d corners(Index t) const;

  void push(Index p);
  void collect_choices(Index p);
  Collapse cheapest(Index p);
  double cost(Index p, Index onto) const;
  double penalty(Index p, Index onto) const;
  bool is_tetrahedron(Index p, Index onto) const;
  bool keeps_lines(Index onto) const;
  bool keeps_topology(Index p, Index onto) const;
  double shape_penalty(Index p, Index onto) const;
  void perform(const Collapse& collapse);

  double max_aspect_ratio_;
  Points points_;
  Triangles triangles_;
  std::vector<std::vector<Index>> around_;  ///< triangles of each point
  std::vector<Quadric> quadric_;
  std::vector<double> area_;  ///< of the surface each point stands for
  std::vector<Index> stamp_;
  std::vector<char> alive_;
  Index left_;
  std::priority_queue<Collapse, std::vector<Collapse>, std::greater<>> queue_;
  // Scratch of `cheapest`: the ring of the point that goes, also as marks, what going to each of
  // its points costs, and the worst aspect ratio around it.
  Ring ring_;
  std::vector<std::uint32_t> ring_mark_;
  std::vector<Index> ring_place_;
  std::uint32_t ring_number_ = 0;
  std::vector<std::pair<double, Index>> choices_;
  double thinnest_before_ = 0.0;
};

}  // namespace pliant
