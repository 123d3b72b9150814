// The cells: an octree (a quadtree in the plane) over the space a shape fills.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "pliant/deformers/rigid_cells/frame.h"
#include "pliant/deformers/rigid_cells/options.h"
#include "pliant/deformers/rigid_cells/rasterizer.h"

namespace pliant::cells {

/// Two cells that share (part of) a face; weight of eq. 2: A_ij / (h_i + h_j), in the scene's unit,
/// without stiffness.
struct CellPair {
  Index i = 0, j = 0;  ///< i < j
  double weight = 0.0;
};

/// Cells at the boundary are split `boundary_levels` times; no cell is more than twice as wide as one
/// it shares a face with. Two cells at the boundary are a pair only where the shape passes through
/// their common face (two legs side by side are not glued); but small loose parts hang on to what is
/// beside them.
class CellTree {
 public:
  /// The most cells there may be.
  static constexpr Index kMaxCells = 200'000;

  /// Errors: too_large.
  static Result<CellTree> create(const Shape& shape, const RigidCellsOptions& options);

  const GridFrame& frame() const { return frame_; }
  Index size() const { return static_cast<Index>(leaves_.size()); }
  /// Centre of a cell in the scene, and the length of its sides.
  Eigen::Vector3d center(Index cell) const { return frame_.to_scene(grid_center(leaves_[cell])); }
  Points centers() const;
  double side(Index cell) const { return frame_.unit * leaf_side(leaves_[cell]); }
  int level(Index cell) const { return leaves_[cell].level; }
  /// Its lowest corner, grid coordinates.
  const Eigen::Vector3i& corner(Index cell) const { return leaves_[cell].at; }
  /// Neighbours along each axis of the grid, both ways: whether the cell is in a pair there. Bit
  /// 2 axis + (0 below, 1 above).
  std::vector<unsigned char> neighbour_sides() const;
  const std::vector<CellPair>& pairs() const { return pairs_; }
  /// The cell a place (grid coordinates) lies in; -1: none.
  Index cell_containing(const Eigen::Vector3d& place) const;
  /// The cell a place of the scene lies in, or else the nearest one.
  Index cell_at(const Eigen::Vector3d& place) const;

  /// Of each cell those it was before: one, or several that it joins.
  using Origins = std::vector<std::vector<Index>>;
  /// Splits cells (where the depth allows it, and what balance asks for) and finds the pairs anew.
  /// Errors: too_large; nothing has changed then.
  Result<Origins> split(const std::vector<bool>& wanted);
  /// Takes back splits whose children may all go, where balance allows it.
  Origins join(const std::vector<bool>& may_go);

 private:
  struct Leaf {
    Eigen::Vector3i at;  ///< lowest corner, grid coordinates
    int level = 0;
    bool boundary = false;
    std::vector<Index> pieces;               ///< of the shape, in it
    std::shared_ptr<const Leaf> split_from;  ///< made by `split`, which may be taken back ..
    int siblings = 0;                        ///< .. where so many are left of it
  };
  struct Face {
    CenteredBox box;
    Index i, j;
  };

  CellTree(const Shape& shape, const GridFrame& frame) : frame_(frame), raster_(new Rasterizer(shape, frame)) {}

  int leaf_side(const Leaf& leaf) const { return 1 << (frame_.depth - leaf.level); }
  Eigen::Vector3d grid_center(const Leaf& leaf) const;
  CenteredBox box(const Leaf& leaf) const;
  static std::uint64_t key(const Eigen::Vector3i& at, int level);
  std::vector<Leaf> children(const Leaf& leaf) const;
  Status split_boundary(int levels);
  Result<Origins> split_leaves(const std::vector<bool>& wanted, bool for_good);
  /// Whether a leaf may be in the place of smaller ones: beside it none is less than half as wide.
  bool in_balance(const Leaf& leaf) const;
  bool balance(std::vector<bool>& wanted) const;
  void index_leaves();
  /// The leaf that covers the cell of `level` at a place of the grid, or -1: none, or smaller ones.
  Index covering(const Eigen::Vector3i& at, int level) const;
  template <class Visit>
  void for_each_face(Visit&& visit) const;
  bool passes(const Leaf& a, const Leaf& b, const CenteredBox& face) const;
  void find_pairs();
  void add_pair(const Face& face);

  GridFrame frame_;
  std::shared_ptr<Rasterizer> raster_;
  bool interior_ = true;
  std::vector<Leaf> leaves_;
  std::unordered_map<std::uint64_t, Index> leaf_at_;
  std::vector<CellPair> pairs_;
};

}  // namespace pliant::cells
