#include "pliant/geometry/nearest_points.h"

#include <algorithm>

#include <nanoflann.hpp>

namespace pliant {
namespace {

struct PointCloud {
  const Points& points;
  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points.cols()); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points(static_cast<Index>(axis), static_cast<Index>(i));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace

struct NearestPoints::Tree {
  using Search =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud, 3, Index>;
  PointCloud cloud;
  Search search;
  explicit Tree(const Points& points) : cloud{points}, search(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {}
};

NearestPoints::NearestPoints(const Points& points) : tree_(std::make_unique<Tree>(points)) {}
NearestPoints::~NearestPoints() = default;

void NearestPoints::find(const Eigen::Vector3d& place, Index count, std::vector<Index>& found,
                         std::vector<double>& squared) const {
  const std::size_t wanted = std::min<std::size_t>(count, tree_->cloud.kdtree_get_point_count());
  found.resize(wanted);
  squared.resize(wanted);
  tree_->search.knnSearch(place.data(), wanted, found.data(), squared.data());
}

}  // namespace pliant
