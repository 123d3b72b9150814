#include "pliant/geometry/point_grid.h"

#include <bit>
#include <numeric>
#include <vector>

namespace pliant {

PointGrid::PointGrid(const Points& points, double reach)
    : points_(points),
      origin_(points.rowwise().minCoeff()),
      cell_(reach),
      mask_(std::bit_ceil(static_cast<std::uint64_t>(points.cols())) - 1) {
  const Index count = static_cast<Index>(points.cols());
  std::vector<std::uint32_t> bucket_of(count);
  buckets_.offsets.assign(mask_ + 2, 0);
  for (Index i = 0; i < count; ++i) {
    bucket_of[i] = bucket(cell_of(points.col(i)));
    ++buckets_.offsets[bucket_of[i] + 1];
  }
  std::partial_sum(buckets_.offsets.begin(), buckets_.offsets.end(), buckets_.offsets.begin());
  buckets_.items.resize(count);
  std::vector<Index> next(buckets_.offsets.begin(), buckets_.offsets.end() - 1);
  for (Index i = 0; i < count; ++i) {
    buckets_.items[next[bucket_of[i]]++] = i;
  }
}

PointGrid::Cell PointGrid::cell_of(const Eigen::Vector3d& p) const {
  return ((p - origin_) / cell_).array().floor().matrix().cast<std::int64_t>();
}

std::uint32_t PointGrid::bucket(const Cell& cell) const {
  std::uint64_t mixed = 0;
  for (const std::int64_t index : cell) {
    mixed = (mixed ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
    mixed ^= mixed >> 29;
  }
  return static_cast<std::uint32_t>(mixed & mask_);
}

}  // namespace pliant
