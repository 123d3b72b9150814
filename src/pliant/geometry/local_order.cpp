#include "pliant/geometry/local_order.h"

#include <cstdint>

#include "pliant/core/sort.h"

namespace pliant {
namespace {

/// Bits of a coordinate: three of them fill a key.
constexpr int kBits = 21;

/// Two zero bits after every bit.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x1f00000000ffffu;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

}  // namespace

std::vector<Index> local_order(const Points& points) {
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const double side = (points.colwise() - low).maxCoeff();
  const double scale = side > 0.0 ? ((1 << kBits) - 1) / side : 0.0;
  return order_by(static_cast<Index>(points.cols()), [&](Index p) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread(static_cast<std::uint64_t>((points(k, p) - low[k]) * scale)) << k;
    return key;
  });
}

}  // namespace pliant
