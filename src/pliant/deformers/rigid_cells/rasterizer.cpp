#include "pliant/deformers/rigid_cells/rasterizer.h"

#include <algorithm>
#include <cmath>

#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/nearest_points.h"

namespace pliant::cells {
namespace {

/// Points without triangles hang together with this many of their neighbours ..
constexpr Index kNeighbours = 6;
/// .. unless these are farther than this many times what is usual.
constexpr double kFar = 4.0;

}  // namespace

Rasterizer::Rasterizer(const Shape& shape, const GridFrame& frame)
    : frame_(frame), points_(3, shape.points().cols()), surface_(shape.triangles()) {
  for (Index p = 0; p < points_.cols(); ++p) points_.col(p) = frame.to_grid(shape.points().col(p));
  pieces_ = surface_;
  if (surface_.cols() == 0) {
    connect_points();
  } else if (frame.dimension == 3) {
    winding_.emplace(points_, surface_);
  } else {
    find_outline();
  }
  add_loose_points();
}

void Rasterizer::connect_points() {
  if (points_.cols() < 2) return;
  const NearestPoints nearest(points_);
  std::vector<Index> found;
  std::vector<double> squared, farthest;
  std::vector<std::vector<std::pair<Index, double>>> neighbours(points_.cols());
  for (Index p = 0; p < points_.cols(); ++p) {
    nearest.find(points_.col(p), kNeighbours + 1, found, squared);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] != p) neighbours[p].emplace_back(found[i], squared[i]);
    }
    farthest.push_back(squared.back());
  }
  const auto middle = farthest.begin() + static_cast<std::ptrdiff_t>(farthest.size() / 2);
  std::nth_element(farthest.begin(), middle, farthest.end());
  const double most = kFar * kFar * *middle;
  std::vector<Eigen::Vector3i> segments;
  for (Index p = 0; p < points_.cols(); ++p) {
    for (const auto& [q, distance] : neighbours[p]) {
      if (distance <= most) segments.emplace_back(p, q, q);
    }
  }
  pieces_.resize(3, static_cast<Index>(segments.size()));
  for (Index s = 0; s < pieces_.cols(); ++s) pieces_.col(s) = segments[s];
}

void Rasterizer::add_loose_points() {
  std::vector<bool> used(points_.cols(), false);
  for (const Index corner : pieces_.reshaped()) used[corner] = true;
  std::vector<Index> loose;
  for (Index p = 0; p < points_.cols(); ++p) {
    if (!used[p]) loose.push_back(p);
  }
  const Index before = static_cast<Index>(pieces_.cols());
  pieces_.conservativeResize(3, before + static_cast<Index>(loose.size()));
  for (std::size_t i = 0; i < loose.size(); ++i) pieces_.col(before + static_cast<Index>(i)).setConstant(loose[i]);
}

void Rasterizer::find_outline() {
  outline_.assign(surface_.cols(), 0);
  const Incidence around = triangles_of_points(surface_, static_cast<Index>(points_.cols()));
  for_each_edge(surface_, around, [&](Index a, Index b, std::span<const Index> triangles) {
    if (triangles.size() != 1) return;
    const Index t = triangles[0];
    for (int k = 0; k < 3; ++k) {
      const Index from = surface_(k, t), to = surface_((k + 1) % 3, t);
      if (std::min(from, to) == a && std::max(from, to) == b) outline_[t] |= static_cast<unsigned char>(1 << k);
    }
  });
}

Eigen::Matrix3d Rasterizer::corners(Index piece) const { return points_(Eigen::all, pieces_.col(piece)); }

std::vector<std::vector<Index>> Rasterizer::coarse_cells() {
  std::vector<std::vector<Index>> cells(static_cast<std::size_t>(frame_.counts.prod()));
  const double side = static_cast<double>(1 << frame_.depth);
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(side / 2.0);
  for (Index piece = 0; piece < pieces_.cols(); ++piece) {
    const Eigen::Matrix3d corner = corners(piece);
    Eigen::Vector3i low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const int last = frame_.counts[axis] - 1;
      low[axis] = std::clamp(static_cast<int>(std::floor(corner.row(axis).minCoeff() / side)), 0, last);
      high[axis] = std::clamp(static_cast<int>(std::floor(corner.row(axis).maxCoeff() / side)), 0, last);
    }
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          Eigen::Vector3d center = side * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
          if (frame_.dimension == 2) center.z() = 0.0;
          if (triangle_meets_box(corner, {center, half})) cells[coarse_index({x, y, z})].push_back(piece);
        }
      }
    }
  }
  if (surface_.cols() == 0) flood_from_outside(cells);
  return cells;
}

void Rasterizer::flood_from_outside(const std::vector<std::vector<Index>>& occupied) {
  enclosed_.assign(occupied.size(), true);
  std::vector<Eigen::Vector3i> open;
  const auto reach = [&](const Eigen::Vector3i& cell) {
    if ((cell.array() < 0).any() || (cell.array() >= frame_.counts.array()).any()) return;
    const Index at = coarse_index(cell);
    if (!enclosed_[at] || !occupied[at].empty()) return;
    enclosed_[at] = false;
    open.push_back(cell);
  };
  const int flat = frame_.dimension;
  for (int z = 0; z < frame_.counts.z(); ++z) {
    for (int y = 0; y < frame_.counts.y(); ++y) {
      for (int x = 0; x < frame_.counts.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        bool border = false;
        for (int axis = 0; axis < flat; ++axis) border |= cell[axis] == 0 || cell[axis] == frame_.counts[axis] - 1;
        if (border) reach(cell);
      }
    }
  }
  while (!open.empty()) {
    const Eigen::Vector3i cell = open.back();
    open.pop_back();
    for (int axis = 0; axis < flat; ++axis) {
      reach(cell + Eigen::Vector3i::Unit(axis));
      reach(cell - Eigen::Vector3i::Unit(axis));
    }
  }
}

std::vector<Index> Rasterizer::meeting(const std::vector<Index>& pieces, const CenteredBox& box) const {
  std::vector<Index> some;
  for (const Index piece : pieces) {
    if (triangle_meets_box(corners(piece), box)) some.push_back(piece);
  }
  return some;
}

bool Rasterizer::any_meets(const std::vector<Index>& pieces, const CenteredBox& box) const {
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](Index piece) { return triangle_meets_box(corners(piece), box); });
}

bool Rasterizer::at_boundary(const std::vector<Index>& pieces, const CenteredBox& box) const {
  if (outline_.empty()) return !pieces.empty();
  for (const Index piece : pieces) {
    if (piece >= static_cast<Index>(outline_.size())) return true;
    for (int k = 0; k < 3; ++k) {
      if ((outline_[piece] >> k & 1) == 0) continue;
      Eigen::Matrix3d edge = corners(piece);
      edge.col((k + 2) % 3) = edge.col(k);
      if (triangle_meets_box(edge, box)) return true;
    }
  }
  return false;
}

bool Rasterizer::inside(const Eigen::Vector3d& place) const {
  if (winding_) return std::abs(winding_->at(place)) > 0.5;
  if (enclosed_.empty()) return false;
  Eigen::Vector3i cell = (place / static_cast<double>(1 << frame_.depth)).array().floor().matrix().cast<int>();
  cell = cell.cwiseMax(0).cwiseMin(frame_.counts - Eigen::Vector3i::Ones());
  return enclosed_[coarse_index(cell)];
}

}  // namespace pliant::cells
