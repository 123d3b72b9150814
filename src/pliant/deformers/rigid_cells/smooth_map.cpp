#include "pliant/deformers/rigid_cells/smooth_map.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "pliant/core/disjoint_sets.h"
#include "pliant/linalg/dense_kernels.h"
#include "pliant/linalg/radial_basis.h"

namespace pliant::cells {
namespace {

using dense::load2;
using dense::splat2;
using dense::store2;
using dense::Vec2;

/// Centres that a sample is made from.
constexpr int kCenters = 48;
/// Squared distances closer than this, relative, are equal.
constexpr double kTie = 1e-6;
/// Where a part has fewer centres near a sample, more of what hangs together with it count.
constexpr Index kFewest = 20;
/// How far from a sample the way from a cell to centres near it may lead, over the farthest of these.
constexpr double kDetour = 1.5;
/// Samples of a block along an axis.
constexpr int kBlock = 2;

/// Cubic B-splines at t in [0, 1] of the interval between the second and the third.
std::array<double, 4> spline_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0, (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
          t * t * t / 6.0};
}

/// Axes along which neither a cell nor any of its neighbours has a neighbour: bit for each.
std::vector<unsigned char> thin_axes(const CellTree& tree) {
  const std::vector<unsigned char> sides = tree.neighbour_sides();
  std::vector<unsigned char> joined(sides.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((sides[i] >> (2 * axis) & 3) != 0) joined[i] |= static_cast<unsigned char>(1 << axis);
    }
  }
  std::vector<unsigned char> around = joined;
  for (const CellPair& pair : tree.pairs()) {
    around[pair.i] |= joined[pair.j];
    around[pair.j] |= joined[pair.i];
  }
  for (unsigned char& axes : around) axes = static_cast<unsigned char>(~axes);
  return around;
}

/// Of cells in limbs one cell thick: centres alone do not see how they turn.
Points face_centers(const CellTree& tree, std::vector<Index>& cell_of) {
  std::vector<Eigen::Vector3d> places;
  const std::vector<unsigned char> thin = thin_axes(tree);
  for (Index i = 0; i < tree.size(); ++i) {
    for (int axis = 0; axis < tree.frame().dimension; ++axis) {
      if ((thin[i] >> axis & 1) == 0) continue;
      for (const double sign : {-0.5, 0.5}) {
        places.push_back(tree.center(i) + sign * tree.side(i) * tree.frame().axes.row(axis).transpose());
        cell_of.push_back(i);
      }
    }
  }
  Points result(3, static_cast<Index>(places.size()));
  for (Index p = 0; p < result.cols(); ++p) result.col(p) = places[p];
  return result;
}

Incidence rows_of(Index rows, const std::vector<std::array<Index, 2>>& entries) {
  Incidence result;
  result.offsets.assign(rows + 1, 0);
  for (const auto& [row, item] : entries) ++result.offsets[row + 1];
  for (Index r = 0; r < rows; ++r) result.offsets[r + 1] += result.offsets[r];
  result.items.resize(entries.size());
  std::vector<Index> next(result.offsets.begin(), result.offsets.end() - 1);
  for (const auto& [row, item] : entries) result.items[next[row]++] = item;
  return result;
}

}  // namespace

SmoothMap::SmoothMap(const CellTree& tree)
    : tree_(tree),
      frame_(tree.frame()),
      depth_(tree.frame().dimension == 2 ? 1 : kTaps),
      cell_centers_(tree.centers()),
      nearest_((choose_centers(tree), centers_)) {}

void SmoothMap::choose_centers(const CellTree& tree) {
  int deepest = 0;
  for (Index i = 0; i < tree.size(); ++i) {
    deepest = std::max(deepest, tree.level(i));
    cell_of_center_.push_back(i);
  }
  spacing_ = static_cast<double>(1 << (frame_.depth - deepest));
  const Points faces = face_centers(tree, cell_of_center_);
  rest_.resize(3, cell_centers_.cols() + faces.cols());
  rest_ << cell_centers_, faces;
  centers_.resize(3, rest_.cols());
  for (Index c = 0; c < rest_.cols(); ++c) centers_.col(c) = frame_.to_grid(rest_.col(c));
  std::vector<std::array<Index, 2>> entries;
  for (Index c = 0; c < rest_.cols(); ++c) entries.push_back({cell_of_center_[c], c});
  centers_of_cell_ = rows_of(tree.size(), entries);
  entries.clear();
  for (const CellPair& pair : tree.pairs()) {
    entries.push_back({pair.i, pair.j});
    entries.push_back({pair.j, pair.i});
  }
  neighbours_ = rows_of(tree.size(), entries);
  mark_.assign(tree.size(), -1);
  reached_.assign(tree.size(), false);
}

std::uint64_t SmoothMap::key(const Eigen::Vector3i& at) {
  constexpr int kOffset = 1 << 20;  // places around the grid, too
  std::uint64_t result = 0;
  for (const int k : at) result = result << 21 | (static_cast<std::uint64_t>(k + kOffset) & ((1u << 21) - 1));
  return result;
}

Eigen::Vector3d SmoothMap::middle_of_block(const Eigen::Vector3i& at) const {
  Eigen::Vector3d middle = spacing_ * ((at * kBlock).cast<double>().array() + (kBlock - 1) / 2.0);
  if (frame_.dimension == 2) middle.z() = 0.0;
  return middle;
}

SmoothMap::Site SmoothMap::make_site(const Eigen::Vector3i& at) {
  Site site;
  std::vector<double> squared;
  nearest_.find(middle_of_block(at), 2 * kCenters, site.centers, squared);
  // Of centres equally far all or none: rounding must not choose.
  std::size_t used = std::min<std::size_t>(kCenters, squared.size());
  while (used < squared.size() && squared[used] <= (1.0 + kTie) * squared[used - 1]) ++used;
  site.centers.resize(used);
  for (std::size_t k = 0; k < site.centers.size(); ++k) mark_[cell_of_center_[site.centers[k]]] = static_cast<Index>(k);
  DisjointSets parts(static_cast<Index>(site.centers.size()));
  for (std::size_t k = 0; k < site.centers.size(); ++k) {
    const Index cell = cell_of_center_[site.centers[k]];
    parts.join(static_cast<Index>(k), mark_[cell]);
    for (const Index other : neighbours_.row(cell)) {
      if (mark_[other] >= 0) parts.join(mark_[cell], mark_[other]);
    }
  }
  for (const Index center : site.centers) mark_[cell_of_center_[center]] = -1;
  site.part = parts.roots();
  return site;
}

template <class Visit>
void SmoothMap::walk(Index from, const Eigen::Vector3d& towards, Visit&& visit) {
  using Reached = std::pair<double, Index>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::vector<Index> reached;
  const auto reach = [&](Index cell) {
    if (reached_[cell]) return;
    reached_[cell] = true;
    reached.push_back(cell);
    open.emplace((centers_.col(cell) - towards).squaredNorm(), cell);
  };
  reach(from);
  while (!open.empty()) {
    const Index cell = open.top().second;
    open.pop();
    if (!visit(cell)) break;
    for (const Index other : neighbours_.row(cell)) reach(other);
  }
  for (const Index cell : reached) reached_[cell] = false;
}

SmoothMap::Block SmoothMap::make_block(const Eigen::Vector3i& at, std::vector<Index> centers) const {
  const int flat = frame_.dimension;
  RadialBasis basis(centers_(Eigen::all, centers));
  // A B-spline with the samples as they are would smooth them; less a sixth of their Laplacian it
  // does not, to fourth order.
  Eigen::VectorXd factors = Eigen::VectorXd::Constant(1 + 2 * flat, -1.0 / 6.0);
  factors[0] = 1.0 + flat / 3.0;
  const int count = 1 << flat;
  Block block{std::move(centers), {}};
  block.weights.resize(block.centers.size() * count);
  for (int s = 0; s < count; ++s) {
    const Eigen::Vector3d place = spacing_ * (kBlock * at + Eigen::Vector3i(s & 1, s >> 1 & 1, s >> 2)).cast<double>();
    Points places(3, factors.size());
    places.col(0) = place;
    for (int axis = 0; axis < flat; ++axis) {
      places.col(1 + 2 * axis) = place + spacing_ * Eigen::Vector3d::Unit(axis);
      places.col(2 + 2 * axis) = place - spacing_ * Eigen::Vector3d::Unit(axis);
    }
    const Eigen::VectorXd weights = basis.weights(places, factors);
    for (Index c = 0; c < weights.size(); ++c) block.weights[c * count + s] = weights[c];
  }
  return block;
}

Index SmoothMap::part_joined_to(const Site& site, Index cell, const Eigen::Vector3d& middle) {
  for (std::size_t k = 0; k < site.centers.size(); ++k) mark_[cell_of_center_[site.centers[k]]] = static_cast<Index>(k);
  const double reach = kDetour * kDetour * (centers_.col(site.centers.back()) - middle).squaredNorm();
  Index found = -1;
  walk(cell, middle, [&](Index other) {
    if (mark_[other] >= 0) found = site.part[mark_[other]];
    return found < 0 && (centers_.col(other) - middle).squaredNorm() <= reach;
  });
  for (const Index center : site.centers) mark_[cell_of_center_[center]] = -1;
  return found;
}

std::vector<Index> SmoothMap::joined_centers(Index cell, const Eigen::Vector3d& middle) {
  std::vector<Index> centers;
  walk(cell, middle, [&](Index other) {
    for (const Index center : centers_of_cell_.row(other)) centers.push_back(center);
    return static_cast<int>(centers.size()) < kCenters;
  });
  return centers;
}

Index SmoothMap::block(Site& site, const Eigen::Vector3i& at, Index cell) {
  const Eigen::Vector3d middle = middle_of_block(at);
  const Index part = part_joined_to(site, cell, middle);
  const Index name = part >= 0 ? part : static_cast<Index>(site.centers.size()) + cell;
  for (const Site::Seen& seen : site.blocks) {
    if (seen.key == name) return seen.block;
  }
  std::vector<Index> centers;
  for (std::size_t k = 0; k < site.centers.size(); ++k) {
    if (site.part[k] == part) centers.push_back(site.centers[k]);
  }
  // A part is named by the nearest of its centres.
  if (part < 0) centers = joined_centers(cell, middle);
  if (part >= 0 && static_cast<Index>(centers.size()) < kFewest) {
    centers = joined_centers(cell_of_center_[site.centers[part]], middle);
  }
  site.blocks.push_back({name, static_cast<Index>(blocks_.size())});
  blocks_.push_back(make_block(at, std::move(centers)));
  return site.blocks.back().block;
}

Index SmoothMap::sample(const Eigen::Vector3i& at, Index cell) {
  Eigen::Vector3i of_block = Eigen::Vector3i::Zero();
  Index within = 0;
  for (int axis = 0; axis < frame_.dimension; ++axis) {
    of_block[axis] = at[axis] >> 1;  // towards minus infinity
    within |= (at[axis] & 1) << axis;
  }
  const auto [found, fresh] = sites_.try_emplace(key(of_block));
  if (fresh) found->second = make_site(of_block);
  return (block(found->second, of_block, cell) << frame_.dimension) + within;
}

Index SmoothMap::cell_of_cube(const Eigen::Vector3i& at) const {
  Eigen::Vector3d middle = spacing_ * (at.cast<double>().array() + 0.5);
  if (frame_.dimension == 2) middle.z() = 0.0;
  const Index cell = tree_.cell_containing(middle);
  if (cell >= 0) return cell;
  std::vector<Index> found;
  std::vector<double> squared;
  nearest_.find(middle, 1, found, squared);
  return cell_of_center_[found[0]];
}

Index SmoothMap::cube(const Eigen::Vector3i& at) {
  const auto [found, fresh] = cube_at_.try_emplace(key(at), static_cast<Index>(cubes_.size()));
  if (!fresh) return found->second;
  const Index cell = cell_of_cube(at);
  std::array<Index, 64> samples{};
  std::size_t n = 0;
  for (int z = 0; z < depth_; ++z) {
    for (int y = 0; y < kTaps; ++y) {
      for (int x = 0; x < kTaps; ++x) {
        samples[n++] = sample(at + Eigen::Vector3i(x - 1, y - 1, depth_ == 1 ? 0 : z - 1), cell);
      }
    }
  }
  cubes_.push_back(samples);
  return found->second;
}

SmoothMap::Places SmoothMap::place(const Points& points) {
  Places places;
  std::unordered_map<Index, Index> slot_of;
  std::vector<Index> slots;
  std::vector<std::array<double, 3>> within;
  for (Index p = 0; p < points.cols(); ++p) {
    const Eigen::Vector3d g = frame_.to_grid(points.col(p)) / spacing_;
    Eigen::Vector3d low = g.array().floor().max(-1e6).min(1e6);
    if (frame_.dimension == 2) low.z() = 0.0;
    const Index found = cube(low.cast<int>());
    const auto [slot, fresh] = slot_of.try_emplace(found, static_cast<Index>(places.cubes.size()));
    if (fresh) places.cubes.push_back(found);
    slots.push_back(slot->second);
    within.push_back({g.x() - low.x(), g.y() - low.y(), frame_.dimension == 2 ? 0.0 : g.z() - low.z()});
  }
  places.offsets.assign(places.cubes.size() + 1, 0);
  for (const Index slot : slots) ++places.offsets[slot + 1];
  for (std::size_t c = 0; c < places.cubes.size(); ++c) places.offsets[c + 1] += places.offsets[c];
  places.points.resize(slots.size());
  places.within.resize(slots.size());
  std::vector<Index> next(places.offsets.begin(), places.offsets.end() - 1);
  for (Index p = 0; p < points.cols(); ++p) {
    const Index at = next[slots[p]]++;
    places.points[at] = p;
    places.within[at] = within[p];
  }
  return places;
}

void SmoothMap::set_motions(const std::vector<CellMotion>& motions, const Eigen::Vector3d& origin) {
  moves_.resize(4 * cell_of_center_.size());
  for (Index c = 0; c < rest_.cols(); ++c) {
    const CellMotion& motion = motions[cell_of_center_[c]];
    const Eigen::Vector3d center = cell_centers_.col(cell_of_center_[c]);
    const Eigen::Vector3d arm = rest_.col(c) - center;
    const Eigen::Vector3d move = (motion.center - (center - origin)) + (motion.rotation * arm - arm);
    for (int k = 0; k < 3; ++k) moves_[4 * c + k] = move[k];
    moves_[4 * c + 3] = 0.0;
  }
  taken_ = 0;
}

void SmoothMap::take_samples() {
  const int count = 1 << frame_.dimension;
  samples_.resize(4 * static_cast<std::size_t>(count) * blocks_.size());
  for (; taken_ < blocks_.size(); ++taken_) {
    const Block& block = blocks_[taken_];
    Vec2 sum[8][2] = {};
    const double* weights = block.weights.data();
    for (const Index center : block.centers) {
      const Vec2 xy = load2(&moves_[4 * center]), z = load2(&moves_[4 * center + 2]);
      for (int s = 0; s < count; ++s, ++weights) {
        sum[s][0] += splat2(*weights) * xy;
        sum[s][1] += splat2(*weights) * z;
      }
    }
    double* to = &samples_[4 * count * taken_];
    for (int s = 0; s < count; ++s) {
      store2(to + 4 * s, sum[s][0]);
      store2(to + 4 * s + 2, sum[s][1]);
    }
  }
}

void SmoothMap::carry_cube(const Places& places, std::size_t c, const Points& points, Points& out) const {
  const std::array<Index, 64>& of_cube = cubes_[places.cubes[c]];
  Vec2 xy[64], z0[64];
  for (int s = 0; s < kTaps * kTaps * depth_; ++s) {
    xy[s] = load2(&samples_[4 * of_cube[s]]);
    z0[s] = load2(&samples_[4 * of_cube[s] + 2]);
  }
  for (Index at = places.offsets[c]; at < places.offsets[c + 1]; ++at) {
    const auto [tx, ty, tz] = places.within[at];
    const std::array<double, 4> wx = spline_weights(tx), wy = spline_weights(ty);
    const std::array<double, 4> wz = depth_ == 1 ? std::array<double, 4>{1.0} : spline_weights(tz);
    Vec2 sum_xy = {}, sum_z = {};
    int s = 0;
    for (int k = 0; k < depth_; ++k) {
      Vec2 plane_xy = {}, plane_z = {};
      for (int j = 0; j < kTaps; ++j, s += kTaps) {
        Vec2 row_xy = {}, row_z = {};
        for (int i = 0; i < kTaps; ++i) {
          row_xy += splat2(wx[i]) * xy[s + i];
          row_z += splat2(wx[i]) * z0[s + i];
        }
        plane_xy += splat2(wy[j]) * row_xy;
        plane_z += splat2(wy[j]) * row_z;
      }
      sum_xy += splat2(wz[k]) * plane_xy;
      sum_z += splat2(wz[k]) * plane_z;
    }
    const double* from = points.data() + 3 * places.points[at];
    double* to = out.data() + 3 * places.points[at];
    to[0] = from[0] + sum_xy[0];
    to[1] = from[1] + sum_xy[1];
    to[2] = from[2] + sum_z[0];
  }
}

void SmoothMap::carry(const Places& places, const Points& points, Points& out) {
  take_samples();
  out.resize(3, points.cols());
  for (std::size_t c = 0; c < places.cubes.size(); ++c) carry_cube(places, c, points, out);
}

}  // namespace pliant::cells
