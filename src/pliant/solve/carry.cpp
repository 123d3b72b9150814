#include "pliant/solve/carry.h"

#include "pliant/linalg/dense_kernels.h"

namespace pliant {
namespace {

using dense::load2;
using dense::splat2;
using dense::store2;
using dense::Vec2;

/// One point: the blended map, then where it takes the point. K > 0 fixes the number of influences
/// at compile time.
template <int K>
inline void carry_one(const double* maps, int k, const Index* nodes, const double* weights, const double* point,
                      const double* origin, double* out) {
  const double p[3] = {point[0] - origin[0], point[1] - origin[1], point[2] - origin[2]};
  Vec2 m[6] = {};
  for (int s = 0; s < (K > 0 ? K : k); ++s) {
    const double* map = maps + 12 * static_cast<std::ptrdiff_t>(nodes[s]);
    const Vec2 w = splat2(weights[s]);
    for (int i = 0; i < 6; ++i) m[i] += w * load2(map + 2 * i);
  }
  store2(out, load2(point) + m[0] * splat2(p[0]) + m[1] * splat2(p[1]) + m[2] * splat2(p[2]) + m[3]);
  out[2] = point[2] + (m[4][0] * p[0] + m[4][1] * p[1]) + (m[5][0] * p[2] + m[5][1]);
}

template <int K>
void carry_all(const PackedMaps& maps, const Influences& influences, const Points& points,
               const Eigen::Vector3d& origin, Points& out) {
  const int k = influences.k;
  const Index* nodes = influences.indices.data();
  const double* weights = influences.weights.data();
  for (Index i = 0; i < points.cols(); ++i, nodes += k, weights += k) {
    carry_one<K>(maps.data(), k, nodes, weights, points.data() + 3 * i, origin.data(), out.data() + 3 * i);
  }
}

}  // namespace

Eigen::Matrix<double, 12, 1> pack_map(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix<double, 12, 1> packed;
  packed << a(0, 0), a(1, 0), a(0, 1), a(1, 1), a(0, 2), a(1, 2), b[0], b[1], a(2, 0), a(2, 1), a(2, 2), b[2];
  return packed;
}

void carry(const PackedMaps& maps, const Influences& influences, const Points& points, const Eigen::Vector3d& origin,
           Points& out) {
  out.resize(3, points.cols());
  if (influences.k == 4) {
    carry_all<4>(maps, influences, points, origin, out);
  } else {
    carry_all<0>(maps, influences, points, origin, out);
  }
}

}  // namespace pliant
