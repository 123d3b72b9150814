#include "pliant/linalg/substitution.h"

#include <algorithm>
#include <type_traits>

namespace pliant::dense {
namespace {

/// Calls f with 0, 4, 8, .. below n, and the number of rows or columns (a constant) from there.
template <class F>
inline void for_tiles(int n, F f) {
  int i = 0;
  for (; i + 4 <= n; i += 4) f(i, std::integral_constant<int, 4>());
  for (; i < n; ++i) f(i, std::integral_constant<int, 1>());
}

/// sum[r] += sum over k < columns of L[r, k] y[k]; ld between the columns of L.
template <class Lanes, int N>
inline void add_rows(const typename Lanes::Scalar* l, std::ptrdiff_t ld, int columns, const typename Lanes::Scalar* y,
                     Lanes (&sum)[N]) {
  for (int k = 0; k < columns; ++k, l += ld, y += Lanes::stride) {
    const Lanes yk = Lanes::load(y);
    for (int r = 0; r < N; ++r) sum[r].add(l[r], yk);
  }
}

/// sum[c] += sum over i < rows of L[i, c] y[i].
template <class Lanes, int N>
inline void add_columns(const typename Lanes::Scalar* l, std::ptrdiff_t ld, int rows, const typename Lanes::Scalar* y,
                        Lanes (&sum)[N]) {
  for (std::ptrdiff_t i = 0; i < rows; ++i, y += Lanes::stride) {
    const Lanes yi = Lanes::load(y);
    for (int c = 0; c < N; ++c) sum[c].add(l[c * ld + i], yi);
  }
}

template <class Lanes, int N>
inline void store(const Lanes (&sum)[N], typename Lanes::Scalar* to) {
  for (int r = 0; r < N; ++r) sum[r].store(to + r * Lanes::stride);
}

template <class Lanes, int N>
inline void subtract(const Lanes (&sum)[N], typename Lanes::Scalar* from) {
  for (int r = 0; r < N; ++r, from += Lanes::stride) {
    Lanes value = Lanes::load(from);
    value.subtract(sum[r]);
    value.store(from);
  }
}

}  // namespace

template <class Lanes>
void forward_panel(const typename Lanes::Scalar* panel, int rows, int columns, typename Lanes::Scalar* y,
                   typename Lanes::Scalar* below) {
  using Scalar = typename Lanes::Scalar;
  const std::ptrdiff_t ld = rows;
  Scalar solved[kPanelBlock * Lanes::stride];
  for (int k = 0; k < columns; k += kPanelBlock) {
    const int n = std::min(kPanelBlock, columns - k);
    Scalar* block = y + k * Lanes::stride;
    if (k > 0) {
      for_tiles(n, [&](int i, auto size) {
        Lanes sum[size()] = {};
        add_rows(panel + k + i, ld, k, y, sum);
        subtract(sum, block + i * Lanes::stride);
      });
    }
    for_tiles(n, [&](int i, auto size) {
      Lanes sum[size()] = {};
      add_rows(panel + k * ld + k + i, ld, i + size(), block, sum);
      store(sum, solved + i * Lanes::stride);
    });
    std::copy_n(solved, n * Lanes::stride, block);
  }
  for_tiles(rows - columns, [&](int i, auto size) {
    Lanes sum[size()] = {};
    add_rows(panel + columns + i, ld, columns, y, sum);
    store(sum, below + i * Lanes::stride);
  });
}

template <class Lanes>
void backward_panel(const typename Lanes::Scalar* panel, int rows, int columns, typename Lanes::Scalar* y,
                    const typename Lanes::Scalar* below) {
  using Scalar = typename Lanes::Scalar;
  const std::ptrdiff_t ld = rows;
  Scalar solved[kPanelBlock * Lanes::stride];
  for (int k = (columns - 1) / kPanelBlock * kPanelBlock; k >= 0; k -= kPanelBlock) {
    const int n = std::min(kPanelBlock, columns - k), next = k + n;
    Scalar* block = y + k * Lanes::stride;
    for_tiles(n, [&](int j, auto size) {
      Lanes sum[size()] = {};
      const Scalar* column = panel + (k + j) * ld;
      add_columns(column + next, ld, columns - next, y + next * Lanes::stride, sum);
      add_columns(column + columns, ld, rows - columns, below, sum);
      subtract(sum, block + j * Lanes::stride);
    });
    for_tiles(n, [&](int j, auto size) {
      Lanes sum[size()] = {};
      add_columns(panel + (k + j) * ld + k + j, ld, n - j, block + j * Lanes::stride, sum);
      store(sum, solved + j * Lanes::stride);
    });
    std::copy_n(solved, n * Lanes::stride, block);
  }
}

template void forward_panel<One>(const double*, int, int, double*, double*);
template void forward_panel<Three>(const double*, int, int, double*, double*);
template void backward_panel<One>(const double*, int, int, double*, const double*);
template void backward_panel<Three>(const double*, int, int, double*, const double*);

template void forward_panel<RoughThree>(const float*, int, int, float*, float*);
template void backward_panel<RoughThree>(const float*, int, int, float*, const float*);

}  // namespace pliant::dense
