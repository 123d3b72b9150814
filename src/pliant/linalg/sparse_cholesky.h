// Sparse Cholesky for symmetric positive definite block matrices: analyse a pattern once, factorise
// as often as the values change, solve as often as the right-hand side does.
//
// Multifrontal: the pattern is ordered (on nodes, not scalars) and its columns gathered into
// supernodes, so that all arithmetic happens in dense fronts.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/linalg/block_matrix.h"

namespace pliant {

class SparseCholesky {
 public:
  /// Orders the pattern and allocates everything that factorising and solving need.
  /// Errors: too_large (the factor would take more than `kMaxBytes`); the object is then unusable.
  Status analyze(const BlockMatrix& matrix);
  /// The same along a given fill-reducing order (place -> node), which spares finding one.
  Status analyze(const BlockMatrix& matrix, const std::vector<Index>& order);

  /// The same for a matrix over the same edges as one already analysed, with blocks of any size:
  /// takes over its order.
  Status analyze_like(const SparseCholesky& other, const BlockMatrix& matrix);

  /// L L' = matrix, which must have the analysed pattern. No allocation.
  /// Errors: not_solvable (not positive definite).
  Status factorize(const BlockMatrix& matrix);

  /// Solves in place for `columns` right-hand sides of `rows()` entries each, one after the other.
  /// No allocation for up to three columns at a time (more are done in turns).
  void solve(double* x, int columns);

  /// Lets `solve_roughly` work in single precision until the next factorisation if blocks are
  /// of 1 and the pivots lie close enough for that; after `factorize`. Allocates.
  void allow_rough();
  /// Solves in place for three right-hand sides, to about six digits in single precision (half the
  /// memory to read, twice the numbers at a time) where `allow_rough` found that enough: for
  /// metrics, whose last digits decide nothing. Elsewhere as `solve`.
  void solve_roughly(double* x);

  Index rows() const { return nodes_ * block_; }
  /// Scalars stored in L, padding of the dense fronts included.
  std::size_t factor_size() const { return factor_size_; }

  static constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

 private:
  /// Consecutive rows that stay consecutive in the parent's front.
  struct Segment {
    Index from;  ///< first of them, counted below the columns
    Index to;    ///< its node position in the parent's front
    Index count;
  };
  /// Columns [first, first + width) in elimination order; `rows` are the nodes below them.
  struct Supernode {
    Index first = 0;
    Index width = 0;
    Index parent = -1;
    std::vector<Index> children;    ///< ascending: those with rows below their columns
    std::vector<Index> rows;        ///< permuted node ids, ascending
    std::vector<Segment> segments;  ///< where the rows lie in the parent's front
    std::size_t factor = 0;         ///< offset of its panel in a factor
    int side = 0;                   ///< which of stacks_ takes its update matrix: not its parent's
    Index height() const { return width + static_cast<Index>(rows.size()); }
  };
  /// What solving reads of a supernode, close together; its rows below follow one another in
  /// below_.
  struct Panel {
    std::size_t factor;
    Index first, width, rows;
  };
  /// Where a block of the matrix lands: front position of its row and column, transposed or not.
  struct Entry {
    Index source;  ///< edge, or -1 - node for a diagonal block
    Index row, column;
    bool transposed;
  };

  Status prepare(const BlockMatrix& matrix);
  void place_nodes(const BlockMatrix& matrix, const std::vector<Index>& order);
  void find_supernodes(const std::vector<std::vector<Index>>& structure, const std::vector<Index>& parent);
  void link_supernodes();
  void place_entries(const BlockMatrix& matrix);
  std::array<std::size_t, 2> stack_sizes() const;
  void assemble(const BlockMatrix& matrix, std::size_t supernode, double* panel) const;
  /// Doubles of the update matrix a supernode leaves to its parent.
  std::size_t update_size(const Supernode& node) const {
    const std::size_t n = node.rows.size() * static_cast<std::size_t>(block_);
    return n * n;
  }
  /// Adds a child's update matrix to the columns [first, last) of its parent's front, from the row
  /// of the first of them on, which lie at `target`.
  void extend_add(const Supernode& child, const double* source, double* target, std::ptrdiff_t ld, Index first,
                  Index last) const;
  /// What solving works on, in the precision of its lanes.
  template <class Scalar>
  struct Workspace {
    /// Plain memory, as stacks_: zeros would take as long as a tenth of a factorisation.
    std::unique_ptr<Scalar[]> factor;
    std::vector<Scalar> gathered;  ///< right-hand sides in elimination order, as Lanes has them
    std::vector<Scalar> below;     ///< rows below the columns of a panel
  };
  /// Lanes: see substitution.h. Block: block_ where the compiler may know it, else 0. Right-hand
  /// sides are multiplied by `scale` on the way in and divided by it on the way out.
  template <class Lanes, int Block>
  void solve_some(double* x, Workspace<typename Lanes::Scalar>& workspace, double scale = 1.0);

  int block_ = 1;
  Index nodes_ = 0;
  std::size_t edges_ = 0;        ///< of the analysed pattern
  std::vector<Index> position_;  ///< node -> place in elimination order
  std::vector<Supernode> supernodes_;
  std::vector<Index> supernode_of_;  ///< place -> supernode
  std::vector<Panel> panels_;
  std::vector<Index> below_;
  std::vector<std::vector<Entry>> entries_;
  Workspace<double> exact_;
  Workspace<float> rough_;  ///< its factor is null where `solve_roughly` solves exactly
  std::array<std::unique_ptr<double[]>, 2> stacks_;
  std::vector<double> packed_;  ///< tiles of a panel, while factorising
  std::size_t factor_size_ = 0;
};

}  // namespace pliant
