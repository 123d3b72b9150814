// The dense inner loops of the sparse factorisation: column-major, double, two lanes a vector
// (which g++, clang and em++ all turn into SSE2 or WASM SIMD). Only lower triangles are meaningful;
// kernels may write above a diagonal inside the 4 x 4 tiles they work on.
#pragma once

#include <cstddef>
#include <cstring>

namespace pliant::dense {

typedef double Vec2 __attribute__((vector_size(16)));
typedef float Vec4 __attribute__((vector_size(16)));

template <class Vec, class T>
Vec load(const T* p) {
  Vec v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

inline Vec2 load2(const double* p) { return load<Vec2>(p); }
inline void store2(double* p, Vec2 v) { std::memcpy(p, &v, sizeof v); }
inline Vec2 splat2(double x) { return Vec2{x, x}; }

inline Vec4 load4(const float* p) { return load<Vec4>(p); }
inline void store4(float* p, Vec4 v) { std::memcpy(p, &v, sizeof v); }
inline Vec4 splat4(float x) { return Vec4{x, x, x, x}; }

/// to += from, n numbers.
inline void add(const double* from, std::ptrdiff_t n, double* to) {
  std::ptrdiff_t i = 0;
  for (; i + 2 <= n; i += 2) store2(to + i, load2(to + i) + load2(from + i));
  if (i < n) to[i] += from[i];
}

/// Dot product of n numbers each, in eight sums: one alone would wait for each addition.
double dot(const double* a, const double* b, std::ptrdiff_t n);

/// Columns eliminated at a time by `factorize_panel`.
inline constexpr int kPanelBlock = 16;

/// Doubles that `packed` must hold for a front of `rows` rows.
inline std::size_t packed_size(std::size_t rows) { return (rows + 3) / 4 * 4 * kPanelBlock; }

/// Cholesky of the first `columns` columns of a trapezoid of `rows` rows (leading dimension ld):
/// the top becomes L11, with its diagonal blocks of kPanelBlock columns replaced by their inverses
/// (and zeros above), the rest L21. Returns false when a pivot is not positive.
bool factorize_panel(double* panel, std::ptrdiff_t ld, int rows, int columns, double* packed);

/// c = -a a' in the lower triangle of c (n x n); a is n x depth, depth > 0.
void minus_outer(double* c, std::ptrdiff_t ldc, const double* a, std::ptrdiff_t lda, int n, int depth, double* packed);

}  // namespace pliant::dense
