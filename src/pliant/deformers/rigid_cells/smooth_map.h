// The smooth deformation of space that cells define (Botsch 2007, section 6), fast enough to run live.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "pliant/deformers/rigid_cells/cell_tree.h"
#include "pliant/deformers/rigid_cells/energy.h"
#include "pliant/geometry/adjacency.h"
#include "pliant/geometry/nearest_points.h"

namespace pliant::cells {

/// Triharmonic radial basis functions through the moved centres of the cells; in limbs one cell thick
/// also through the centres of faces across, or turns about the limb would go unseen.
///
/// A place follows the cell it lies in (or the nearest one) and what hangs together with that nearby:
/// what lies beside it but is not joined to it, another finger, does not count.
///
/// Plain evaluation costs points times cells. Here the radial basis map is sampled on a lattice as
/// fine as the smallest cells, near points that are carried alone, and points read a tricubic
/// B-spline through the samples: C^2 as well, and it reproduces what is affine. Samples are weighted
/// sums of the nearest centres, found once per rest pose from a small system for every eight of
/// them, so that cost and memory grow with the cells as they do with the points.
class SmoothMap {
 public:
  /// Keeps a reference to the tree.
  explicit SmoothMap(const CellTree& tree);

  /// Points sorted by the lattice's cubes they lie in.
  struct Places {
    std::vector<Index> cubes;    ///< that hold points, each once
    std::vector<Index> offsets;  ///< of each of them in `points`, and the end
    std::vector<Index> points;
    std::vector<std::array<double, 3>> within;  ///< of the points in that order: place in the cube, 0 to 1
  };
  /// Finds the places of points (3 x n, scene coordinates) and the samples they need.
  Places place(const Points& points);

  /// The motions of all cells, about the scene's `origin`. Samples are taken anew when points ask
  /// for them.
  void set_motions(const std::vector<CellMotion>& motions, const Eigen::Vector3d& origin);
  /// out = deformed points; exactly the points where nothing has moved.
  void carry(const Places& places, const Points& points, Points& out);

 private:
  /// Eight samples (four in the plane) side by side, from the same centres.
  struct Block {
    std::vector<Index> centers;
    std::vector<double> weights;  ///< center by center, one of each sample
  };
  /// Where a block lies, and its samples as seen from different cells.
  struct Site {
    std::vector<Index> centers;  ///< the nearest ones ..
    std::vector<Index> part;     ///< .. and what they hang together with among them
    struct Seen {
      Index key, block;
    };
    std::vector<Seen> blocks;
  };
  static constexpr int kTaps = 4;

  void choose_centers(const CellTree& tree);
  static std::uint64_t key(const Eigen::Vector3i& at);
  Index sample(const Eigen::Vector3i& at, Index cell);
  Index cube(const Eigen::Vector3i& at);
  Index cell_of_cube(const Eigen::Vector3i& at) const;
  Eigen::Vector3d middle_of_block(const Eigen::Vector3i& at) const;
  Site make_site(const Eigen::Vector3i& at);
  /// The samples at a site as a cell sees them.
  Index block(Site& site, const Eigen::Vector3i& at, Index cell);
  /// The part of a site's centres that a cell hangs together with nearby; -1: none.
  Index part_joined_to(const Site& site, Index cell, const Eigen::Vector3d& middle);
  /// Visits what hangs together with a cell, always the nearest to a place next, while told to.
  template <class Visit>
  void walk(Index from, const Eigen::Vector3d& towards, Visit&& visit);
  /// Centres near a place of what hangs together with a cell.
  std::vector<Index> joined_centers(Index cell, const Eigen::Vector3d& middle);
  Block make_block(const Eigen::Vector3i& at, std::vector<Index> centers) const;
  void take_samples();
  void carry_cube(const Places& places, std::size_t c, const Points& points, Points& out) const;

  const CellTree& tree_;
  GridFrame frame_;
  double spacing_;  ///< of the lattice, in grid units
  int depth_;       ///< of a cube of samples along z: 4, or 1 in the plane
  Points centers_;  ///< grid coordinates
  std::vector<Index> cell_of_center_;
  Incidence centers_of_cell_, neighbours_;
  std::vector<Index> mark_;  ///< of each cell, while looking around
  std::vector<bool> reached_;
  Points rest_;  ///< the centres in the scene
  Points cell_centers_;
  NearestPoints nearest_;

  std::vector<Block> blocks_;
  std::unordered_map<std::uint64_t, Site> sites_;
  std::unordered_map<std::uint64_t, Index> cube_at_;
  std::vector<std::array<Index, 64>> cubes_;  ///< samples of each
  std::vector<double> moves_;                 ///< of the centres, four numbers each
  std::vector<double> samples_;               ///< the same of the samples
  std::size_t taken_ = 0;                     ///< blocks whose samples are those of the motions
};

}  // namespace pliant::cells
