#include "pliant/deformers/arap/rotations.h"

#include <cmath>

#include "pliant/geometry/closest_rotation.h"
#include "pliant/linalg/dense_kernels.h"

namespace pliant::arap {
namespace {

using dense::splat2;
using dense::Vec2;

/// (s1 + s2)(s2 + s3)(s3 + s1) over (s1 + s2 + s3)^3, singular values signed: below this the closed
/// form has fewer than ten digits left.
constexpr double kLeastGap = 1e-2;
/// Newton steps for the largest root, at most. The start is exact for flat neighbourhoods, others take up to 6 and
/// reflected ones, whose two largest roots lie close together, up to 12. Where these are not enough an SVD takes over.
constexpr int kRootSteps = 12;
/// A step this small, squared, leaves nothing but rounding: the steps' lengths are squared from one
/// to the next, times at most 200 where the gap is not too small.
constexpr double kLastStep = 1e-20;

Vec2 square_root(Vec2 v) { return Vec2{std::sqrt(v[0]), std::sqrt(v[1])}; }

/// Two covariances side by side, `s` column-major with squared norm 1; the rotations into `r`.
/// Returns the gap of each, 0 where the root was not found.
Vec2 fit_two(const Vec2 s[9], Vec2 r[9]) {
  Vec2 cofactor[9];
  for (int c = 0; c < 3; ++c) {
    const Vec2 *a = s + (c + 1) % 3 * 3, *b = s + (c + 2) % 3 * 3;
    cofactor[3 * c] = a[1] * b[2] - a[2] * b[1];
    cofactor[3 * c + 1] = a[2] * b[0] - a[0] * b[2];
    cofactor[3 * c + 2] = a[0] * b[1] - a[1] * b[0];
  }
  const Vec2 det = s[0] * cofactor[0] + s[1] * cofactor[1] + s[2] * cofactor[2];
  Vec2 minors = cofactor[0] * cofactor[0];
  for (int k = 1; k < 9; ++k) minors += cofactor[k] * cofactor[k];

  // Largest root of (x^2 - 1)^2 - 8 det x - 4 |cofactors|^2: the sum of the singular values.
  Vec2 root = square_root(1.0 + 2.0 * square_root(minors)), last = splat2(1.0);
  for (int i = 0; i < kRootSteps && !(last[0] < kLastStep && last[1] < kLastStep); ++i) {
    const Vec2 q = root * root - 1.0;
    const Vec2 step = (q * q - 8.0 * det * root - 4.0 * minors) / (4.0 * q * root - 8.0 * det + 1e-300);
    root -= step;
    last = step * step;
  }
  const Vec2 kappa = 0.5 * (root * root - 1.0);
  const Vec2 zeta = kappa * root - det;

  // R = ((kappa + 1) S + root cofactors - S S' S) / zeta.
  Vec2 gram[9];  // S' S
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b <= a; ++b) {
      gram[3 * a + b] = s[3 * a] * s[3 * b] + s[3 * a + 1] * s[3 * b + 1] + s[3 * a + 2] * s[3 * b + 2];
      gram[3 * b + a] = gram[3 * a + b];
    }
  }
  const Vec2 inverse = 1.0 / zeta;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) {
      const Vec2 cubic = s[k] * gram[3 * c] + s[3 + k] * gram[3 * c + 1] + s[6 + k] * gram[3 * c + 2];
      r[3 * c + k] = inverse * ((kappa + 1.0) * s[3 * c + k] + root * cofactor[3 * c + k] - cubic);
    }
  }
  // Where all minors are rounding a Newton step may leave the range of sums of singular values,
  // 1 to the square root of 3.
  Vec2 gap = zeta / (root * root * root);
  for (int lane = 0; lane < 2; ++lane) {
    if (!(last[lane] < kLastStep && std::abs(root[lane]) < 2.0)) gap[lane] = 0.0;
  }
  return gap;
}

void fit_planar(const double* s, double* r) {
  const double cosine = s[0] + s[4], sine = s[1] - s[3], length = std::hypot(cosine, sine);
  Eigen::Map<Eigen::Matrix3d> rotation(r);
  rotation.setIdentity();
  if (length == 0.0) return;
  rotation(0, 0) = rotation(1, 1) = cosine / length;
  rotation(1, 0) = sine / length;
  rotation(0, 1) = -sine / length;
}

void fit_slowly(const double* s, double* r) {
  const Eigen::Map<const Eigen::Matrix3d> covariance(s);
  Eigen::Map<Eigen::Matrix3d> rotation(r);
  if (covariance.isZero(0.0)) {
    rotation.setIdentity();
  } else {
    rotation = closest_rotation(covariance);
  }
}

}  // namespace

void fit_rotations(const Rotations& covariances, bool planar, Rotations& rotations) {
  const Index n = static_cast<Index>(covariances.cols());
  rotations.resize(9, n);
  if (planar) {
    for (Index i = 0; i < n; ++i) fit_planar(covariances.col(i).data(), rotations.col(i).data());
    return;
  }
  for (Index i = 0; i < n; i += 2) {
    // An odd last one is done twice.
    const Index j = std::min(i + 1, n - 1);
    const double *a = covariances.col(i).data(), *b = covariances.col(j).data();
    Vec2 s[9], r[9], norm = {};
    for (int k = 0; k < 9; ++k) {
      s[k] = Vec2{a[k], b[k]};
      norm += s[k] * s[k];
    }
    const Vec2 scale = 1.0 / square_root(norm);
    for (Vec2& entry : s) entry *= scale;
    const Vec2 gap = fit_two(s, r);
    for (int lane = 0; lane < 2; ++lane) {
      double* out = rotations.col(lane == 0 ? i : j).data();
      for (int k = 0; k < 9; ++k) out[k] = r[k][lane];
      // Not a number, too, goes the slow way.
      if (!(gap[lane] > kLeastGap)) fit_slowly(lane == 0 ? a : b, out);
    }
  }
}

}  // namespace pliant::arap
