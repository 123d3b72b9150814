#include "pliant/deformers/rigid_cells/cell_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "pliant/core/disjoint_sets.h"
#include "pliant/core/message.h"
#include "pliant/core/sort.h"

namespace pliant::cells {
namespace {

/// Coarse cells the grid may have before any is thrown away.
constexpr std::int64_t kMaxCoarse = 1 << 21;
/// A part of the shape smaller than this, of the diagonal, is loose: it hangs on to what is beside it.
constexpr double kLoose = 0.25;
/// How much deeper than the boundary refinement may go.
constexpr int kRefinements = 2;

Status too_many(std::int64_t cells, std::int64_t most) {
  return {ErrorCode::too_large,
          message({"resolution and boundaryLevels ask for ", cells, " cells; expected at most ", most})};
}

}  // namespace

Result<CellTree> CellTree::create(const Shape& shape, const RigidCellsOptions& options) {
  const int depth = options.boundary_levels + kRefinements;
  const GridFrame frame = grid_frame(shape, options.resolution, depth, options.align);
  const std::int64_t coarse = frame.counts.cast<std::int64_t>().prod();
  if (coarse > kMaxCoarse) return too_many(coarse, kMaxCoarse);
  CellTree tree(shape, frame);
  tree.interior_ = options.interior;
  std::vector<std::vector<Index>> occupied = tree.raster_->coarse_cells();
  std::size_t at = 0;
  for (int z = 0; z < frame.counts.z(); ++z) {
    for (int y = 0; y < frame.counts.y(); ++y) {
      for (int x = 0; x < frame.counts.x(); ++x, ++at) {
        Leaf leaf;
        leaf.at = Eigen::Vector3i(x, y, z) * (1 << depth);
        leaf.pieces = std::move(occupied[at]);
        if (leaf.pieces.empty() && !tree.raster_->inside(tree.grid_center(leaf))) continue;
        leaf.boundary = tree.raster_->at_boundary(leaf.pieces, tree.box(leaf));
        tree.leaves_.push_back(std::move(leaf));
      }
    }
  }
  if (Status s = tree.split_boundary(options.boundary_levels); !s.ok()) return s;
  if (!options.interior) std::erase_if(tree.leaves_, [](const Leaf& leaf) { return !leaf.boundary; });
  tree.index_leaves();
  tree.find_pairs();
  return tree;
}

Eigen::Vector3d CellTree::grid_center(const Leaf& leaf) const {
  Eigen::Vector3d center = leaf.at.cast<double>().array() + leaf_side(leaf) / 2.0;
  if (frame_.dimension == 2) center.z() = 0.0;
  return center;
}

CenteredBox CellTree::box(const Leaf& leaf) const {
  return {grid_center(leaf), Eigen::Vector3d::Constant(leaf_side(leaf) / 2.0)};
}

std::uint64_t CellTree::key(const Eigen::Vector3i& at, int level) {
  // 256 coarse cells of 2^6 units fit into 15 bits.
  return static_cast<std::uint64_t>(level) << 60 | static_cast<std::uint64_t>(at.x()) << 40 |
         static_cast<std::uint64_t>(at.y()) << 20 | static_cast<std::uint64_t>(at.z());
}

std::vector<CellTree::Leaf> CellTree::children(const Leaf& leaf) const {
  std::vector<Leaf> to;
  const int half = leaf_side(leaf) / 2;
  for (int child = 0; child < 1 << frame_.dimension; ++child) {
    Leaf next;
    next.at = leaf.at + half * Eigen::Vector3i(child & 1, child >> 1 & 1, child >> 2);
    next.level = leaf.level + 1;
    next.pieces = raster_->meeting(leaf.pieces, box(next));
    if (next.pieces.empty() && leaf.boundary && !raster_->inside(grid_center(next))) continue;
    next.boundary = raster_->at_boundary(next.pieces, box(next));
    if (!next.boundary && !interior_) continue;
    to.push_back(std::move(next));
  }
  return to;
}

Status CellTree::split_boundary(int levels) {
  for (int level = 0; level < levels; ++level) {
    std::vector<bool> wanted;
    for (const Leaf& leaf : leaves_) wanted.push_back(leaf.boundary);
    // A shell keeps nothing of what is inside, so that nothing has to be in balance.
    if (!interior_) {
      std::erase_if(leaves_, [](const Leaf& leaf) { return !leaf.boundary; });
      wanted.assign(leaves_.size(), true);
    }
    if (const auto once = split_leaves(wanted, true); !once.ok()) return once.status();
  }
  return {};
}

Result<CellTree::Origins> CellTree::split(const std::vector<bool>& wanted) {
  auto origins = split_leaves(wanted, false);
  if (origins.ok()) find_pairs();
  return origins;
}

Result<CellTree::Origins> CellTree::split_leaves(const std::vector<bool>& first_wanted, bool for_good) {
  std::vector<Leaf> before = leaves_;
  Origins origins(leaves_.size());
  for (Index i = 0; i < size(); ++i) origins[i] = {i};
  std::vector<bool> wanted = first_wanted;
  do {
    std::vector<Leaf> next;
    Origins next_origins;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      if (wanted[i] && leaves_[i].level < frame_.depth) {
        std::vector<Leaf> parts = children(leaves_[i]);
        const auto whole = for_good ? nullptr : std::make_shared<const Leaf>(std::move(leaves_[i]));
        for (Leaf& part : parts) {
          part.split_from = whole;
          part.siblings = static_cast<int>(parts.size());
          next.push_back(std::move(part));
        }
      } else {
        next.push_back(std::move(leaves_[i]));
      }
      next_origins.resize(next.size(), origins[i]);
    }
    leaves_ = std::move(next);
    origins = std::move(next_origins);
    if (size() > kMaxCells) {
      const Index cells = size();
      leaves_ = std::move(before);
      index_leaves();
      return too_many(cells, kMaxCells);
    }
    index_leaves();
  } while (balance(wanted));
  return origins;
}

CellTree::Origins CellTree::join(const std::vector<bool>& may_go) {
  std::unordered_map<const Leaf*, std::vector<Index>> parts;
  for (Index i = 0; i < size(); ++i) {
    if (may_go[i] && leaves_[i].split_from) parts[leaves_[i].split_from.get()].push_back(i);
  }
  std::vector<Leaf> next;
  Origins origins;
  for (Index i = 0; i < size(); ++i) {
    Leaf& leaf = leaves_[i];
    const auto found = parts.find(leaf.split_from.get());
    const bool joined = leaf.split_from && found != parts.end() &&
                        static_cast<int>(found->second.size()) == leaf.siblings && in_balance(*leaf.split_from);
    if (joined && found->second.front() != i) continue;
    origins.push_back(joined ? found->second : std::vector<Index>{i});
    next.push_back(joined ? *leaf.split_from : leaf);
  }
  if (next.size() == leaves_.size()) return origins;
  leaves_ = std::move(next);
  index_leaves();
  find_pairs();
  return origins;
}

bool CellTree::in_balance(const Leaf& leaf) const {
  const int side = leaf_side(leaf), quarter = side / 4;
  if (quarter == 0) return true;
  const int across = frame_.dimension == 2 ? 1 : 4;
  for (int axis = 0; axis < frame_.dimension; ++axis) {
    const int u = (axis + 1) % frame_.dimension, v = (axis + 2) % 3;
    for (const int step : {-1, side}) {
      for (int k = 0; k < 4 * across; ++k) {
        Eigen::Vector3i at = leaf.at;
        at[axis] += step;
        at[u] += k % 4 * quarter;
        if (across > 1) at[v] += k / 4 * quarter;
        const Index other = covering(at, frame_.depth);
        if (other >= 0 && leaves_[other].level > leaf.level + 1) return false;
      }
    }
  }
  return true;
}

bool CellTree::balance(std::vector<bool>& wanted) const {
  wanted.assign(leaves_.size(), false);
  bool any = false;
  for (const Leaf& leaf : leaves_) {
    for (int axis = 0; axis < frame_.dimension; ++axis) {
      for (const int step : {-1, leaf_side(leaf)}) {
        Eigen::Vector3i at = leaf.at;
        at[axis] += step;
        const Index other = covering(at, leaf.level);
        if (other < 0 || leaves_[other].level >= leaf.level - 1) continue;
        wanted[other] = any = true;
      }
    }
  }
  return any;
}

void CellTree::index_leaves() {
  leaf_at_.clear();
  leaf_at_.reserve(leaves_.size());
  for (Index i = 0; i < size(); ++i) leaf_at_.emplace(key(leaves_[i].at, leaves_[i].level), i);
}

Index CellTree::covering(const Eigen::Vector3i& at, int level) const {
  if ((at.array() < 0).any() || (at.array() >= frame_.counts.array() * (1 << frame_.depth)).any()) return -1;
  for (; level >= 0; --level) {
    const int side = 1 << (frame_.depth - level);
    const auto found = leaf_at_.find(key(at / side * side, level));
    if (found != leaf_at_.end()) return found->second;
  }
  return -1;
}

template <class Visit>
void CellTree::for_each_face(Visit&& visit) const {
  for (Index i = 0; i < size(); ++i) {
    const Leaf& leaf = leaves_[i];
    const int side = leaf_side(leaf);
    for (int axis = 0; axis < frame_.dimension; ++axis) {
      for (const bool above : {false, true}) {
        Eigen::Vector3i at = leaf.at;
        at[axis] += above ? side : -1;
        const Index other = covering(at, leaf.level);
        // Cells of one size meet twice, from both sides; smaller ones look for the larger.
        if (other < 0 || (leaves_[other].level == leaf.level && !above)) continue;
        Face face{box(leaf), i, other};
        face.box.center[axis] += (above ? 0.5 : -0.5) * side;
        face.box.half[axis] = 0.0;
        visit(face);
      }
    }
  }
}

bool CellTree::passes(const Leaf& a, const Leaf& b, const CenteredBox& face) const {
  if (!a.boundary || !b.boundary) return true;
  if (raster_->any_meets(a.pieces, face)) return true;
  return interior_ && raster_->inside(face.center);
}

void CellTree::add_pair(const Face& face) {
  const double smaller = std::min(side(face.i), side(face.j));
  const double area = frame_.dimension == 2 ? smaller : smaller * smaller;
  pairs_.push_back({std::min(face.i, face.j), std::max(face.i, face.j), 2.0 * area / (side(face.i) + side(face.j))});
}

void CellTree::find_pairs() {
  pairs_.clear();
  DisjointSets parts(size());
  std::vector<Face> closed;
  for_each_face([&](const Face& face) {
    if (passes(leaves_[face.i], leaves_[face.j], face.box)) {
      add_pair(face);
      parts.join(face.i, face.j);
    } else {
      closed.push_back(face);
    }
  });
  // Small loose parts hang on to what is beside them.
  const auto numbered = parts.numbered();
  std::vector<Eigen::AlignedBox3d> extent(numbered.count);
  for (Index i = 0; i < size(); ++i) extent[numbered.of[i]].extend(grid_center(leaves_[i]));
  const double small = kLoose * frame_.middle.norm() * 2.0;
  for (const Face& face : closed) {
    const Index a = numbered.of[face.i], b = numbered.of[face.j];
    if (a != b && std::min(extent[a].diagonal().norm(), extent[b].diagonal().norm()) < small) add_pair(face);
  }
  pairs_ = sorted_by(pairs_, [](const CellPair& pair) { return key_of(pair.i, pair.j); });
}

Points CellTree::centers() const {
  Points all(3, size());
  for (Index i = 0; i < size(); ++i) all.col(i) = center(i);
  return all;
}

std::vector<unsigned char> CellTree::neighbour_sides() const {
  std::vector<unsigned char> sides(leaves_.size(), 0);
  for (const CellPair& pair : pairs_) {
    const Eigen::Vector3d apart = grid_center(leaves_[pair.j]) - grid_center(leaves_[pair.i]);
    int axis = 0;
    apart.cwiseAbs().maxCoeff(&axis);
    const int above = apart[axis] > 0.0 ? 1 : 0;
    sides[pair.i] |= static_cast<unsigned char>(1 << (2 * axis + above));
    sides[pair.j] |= static_cast<unsigned char>(1 << (2 * axis + 1 - above));
  }
  return sides;
}

Index CellTree::cell_containing(const Eigen::Vector3d& place) const {
  Eigen::Vector3i at = place.array().floor().matrix().cast<int>();
  if (frame_.dimension == 2) at.z() = 0;
  return covering(at, frame_.depth);
}

Index CellTree::cell_at(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d g = frame_.to_grid(place);
  if (const Index found = cell_containing(g); found >= 0) return found;
  Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < size(); ++i) {
    const CenteredBox cell = box(leaves_[i]);
    const double distance = ((g - cell.center).cwiseAbs() - cell.half).cwiseMax(0.0).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace pliant::cells
