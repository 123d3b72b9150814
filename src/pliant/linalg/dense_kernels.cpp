#include "pliant/linalg/dense_kernels.h"

#include <algorithm>
#include <cmath>

namespace pliant::dense {
namespace {

/// Copies a (rows x depth) into tiles of four rows, each tile depth x 4, zero-padded: the tile
/// kernel then reads both of its operands in order.
void pack(const double* a, std::ptrdiff_t lda, int rows, int depth, double* packed) {
  for (int i = 0; i < rows; i += 4) {
    const int tile = std::min(4, rows - i);
    for (int p = 0; p < depth; ++p, packed += 4) {
      const double* column = a + p * lda + i;
      for (int r = 0; r < tile; ++r) packed[r] = column[r];
      for (int r = tile; r < 4; ++r) packed[r] = 0.0;
    }
  }
}

/// c (4 x 4) -= x y' for two packed tiles of depth `depth`; c = -x y' where it is Fresh.
template <bool Fresh>
inline void subtract_tile(double* c, std::ptrdiff_t ldc, const double* x, const double* y, int depth) {
  Vec2 sum[4][2] = {};
  for (int p = 0; p < depth; ++p, x += 4, y += 4) {
    const Vec2 x0 = load2(x), x1 = load2(x + 2);
    for (int j = 0; j < 4; ++j) {
      const Vec2 yj = splat2(y[j]);
      sum[j][0] += x0 * yj;
      sum[j][1] += x1 * yj;
    }
  }
  for (int j = 0; j < 4; ++j) {
    double* column = c + j * ldc;
    store2(column, (Fresh ? Vec2{} : load2(column)) - sum[j][0]);
    store2(column + 2, (Fresh ? Vec2{} : load2(column + 2)) - sum[j][1]);
  }
}

/// As subtract_tile, for a tile that is cut off by the border of c.
template <bool Fresh>
void subtract_partial_tile(double* c, std::ptrdiff_t ldc, const double* x, const double* y, int depth, int rows,
                           int columns) {
  double tile[16];
  subtract_tile<true>(tile, 4, x, y, depth);
  for (int j = 0; j < columns; ++j) {
    double* column = c + j * ldc;
    for (int i = 0; i < rows; ++i) column[i] = (Fresh ? 0.0 : column[i]) + tile[4 * j + i];
  }
}

/// c (rows x columns, its lower trapezoid) -= a a(top)' for a packed a; Fresh: as subtract_tile.
template <bool Fresh>
void subtract_packed(double* c, std::ptrdiff_t ldc, const double* packed, int rows, int columns, int depth) {
  for (int j = 0; j < columns; j += 4) {
    const double* y = packed + static_cast<std::ptrdiff_t>(j) * depth;
    const int width = std::min(4, columns - j);
    for (int i = j; i < rows; i += 4) {
      const double* x = packed + static_cast<std::ptrdiff_t>(i) * depth;
      double* tile = c + j * ldc + i;
      if (width == 4 && i + 4 <= rows) {
        subtract_tile<Fresh>(tile, ldc, x, y, depth);
      } else {
        subtract_partial_tile<Fresh>(tile, ldc, x, y, depth, std::min(4, rows - i), width);
      }
    }
  }
}

bool factorize_diagonal(double* a, std::ptrdiff_t ld, int n) {
  for (int j = 0; j < n; ++j) {
    double* column = a + j * ld;
    for (int p = 0; p < j; ++p) {
      const double* previous = a + p * ld;
      const double l = previous[j];
      for (int i = j; i < n; ++i) column[i] -= l * previous[i];
    }
    if (!(column[j] > 0.0)) return false;
    const double root = std::sqrt(column[j]), inverse = 1.0 / root;
    column[j] = root;
    for (int i = j + 1; i < n; ++i) column[i] *= inverse;
  }
  return true;
}

/// Rows below a diagonal block: b <- b L^-T, four rows at a time.
void solve_below(const double* l, double* b, std::ptrdiff_t ld, int rows, int n) {
  double inverse[kPanelBlock];
  for (int j = 0; j < n; ++j) inverse[j] = 1.0 / l[j * ld + j];
  int i = 0;
  for (; i + 4 <= rows; i += 4) {
    Vec2 x[kPanelBlock][2];
    for (int j = 0; j < n; ++j) {
      Vec2 s0 = load2(b + j * ld + i), s1 = load2(b + j * ld + i + 2);
      for (int p = 0; p < j; ++p) {
        const Vec2 ljp = splat2(l[p * ld + j]);
        s0 -= x[p][0] * ljp;
        s1 -= x[p][1] * ljp;
      }
      x[j][0] = s0 * splat2(inverse[j]);
      x[j][1] = s1 * splat2(inverse[j]);
    }
    for (int j = 0; j < n; ++j) {
      store2(b + j * ld + i, x[j][0]);
      store2(b + j * ld + i + 2, x[j][1]);
    }
  }
  for (; i < rows; ++i) {
    for (int j = 0; j < n; ++j) {
      double s = b[j * ld + i];
      for (int p = 0; p < j; ++p) s -= b[p * ld + i] * l[p * ld + j];
      b[j * ld + i] = s * inverse[j];
    }
  }
}

/// The inverse of a triangle of n <= kPanelBlock columns in its place, zeros above the diagonal.
void invert_diagonal(double* l, std::ptrdiff_t ld, int n) {
  double pivot[kPanelBlock];
  for (int j = 0; j < n; ++j) pivot[j] = 1.0 / l[j * ld + j];
  for (int j = 0; j < n; ++j) {
    double* column = l + j * ld;
    for (int i = 0; i < j; ++i) column[i] = 0.0;
    column[j] = pivot[j];
    // Column j of the inverse from L x = e_j; the columns before it are inverted already, those
    // after it are not.
    for (int i = j + 1; i < n; ++i) column[i] *= column[j];
    for (int k = j + 1; k < n; ++k) {
      const double* known = l + k * ld;
      column[k] *= -pivot[k];
      for (int i = k + 1; i < n; ++i) column[i] += known[i] * column[k];
    }
  }
}

}  // namespace

double dot(const double* a, const double* b, std::ptrdiff_t n) {
  Vec2 sum[4] = {};
  std::ptrdiff_t i = 0;
  for (; i + 8 <= n; i += 8) {
    for (int k = 0; k < 4; ++k) sum[k] += load2(a + i + 2 * k) * load2(b + i + 2 * k);
  }
  const Vec2 pairs = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  double total = pairs[0] + pairs[1];
  for (; i < n; ++i) total += a[i] * b[i];
  return total;
}

bool factorize_panel(double* panel, std::ptrdiff_t ld, int rows, int columns, double* packed) {
  for (int k = 0; k < columns; k += kPanelBlock) {
    const int n = std::min(kPanelBlock, columns - k);
    double* diagonal = panel + k * ld + k;
    if (!factorize_diagonal(diagonal, ld, n)) return false;
    const int below = rows - k - n;
    solve_below(diagonal, diagonal + n, ld, below, n);
    if (k + n < columns) {
      pack(diagonal + n, ld, below, n, packed);
      subtract_packed<false>(panel + (k + n) * ld + k + n, ld, packed, below, columns - k - n, n);
    }
    invert_diagonal(diagonal, ld, n);
  }
  return true;
}

void minus_outer(double* c, std::ptrdiff_t ldc, const double* a, std::ptrdiff_t lda, int n, int depth, double* packed) {
  for (int p = 0; p < depth; p += kPanelBlock) {
    const int some = std::min(kPanelBlock, depth - p);
    pack(a + p * lda, lda, n, some, packed);
    (p == 0 ? subtract_packed<true> : subtract_packed<false>)(c, ldc, packed, n, n, some);
  }
}

}  // namespace pliant::dense
