// Forward and backward substitution with one panel of a Cholesky factor, as `factorize_panel`
// leaves it: inverted diagonal blocks, so that both are products and wait for no division.
//
// Right-hand sides lie side by side, row after row: one number a row (One), or three and a pad,
// which fill two vectors (Three) or, in single precision, one (RoughThree).
#pragma once

#include <cstddef>

#include "pliant/linalg/dense_kernels.h"

namespace pliant::dense {

struct One {
  using Scalar = double;
  static constexpr int columns = 1, stride = 1;
  double value = 0.0;
  static One load(const double* p) { return {*p}; }
  void store(double* p) const { *p = value; }
  void add(double l, One y) { value += l * y.value; }
  void subtract(One y) { value -= y.value; }
};

struct Three {
  using Scalar = double;
  static constexpr int columns = 3, stride = 4;
  Vec2 first = {}, second = {};
  static Three load(const double* p) { return {load2(p), load2(p + 2)}; }
  void store(double* p) const {
    store2(p, first);
    store2(p + 2, second);
  }
  void add(double l, Three y) {
    const Vec2 factor = splat2(l);
    first += factor * y.first;
    second += factor * y.second;
  }
  void subtract(Three y) {
    first -= y.first;
    second -= y.second;
  }
};

struct RoughThree {
  using Scalar = float;
  static constexpr int columns = 3, stride = 4;
  Vec4 value = {};
  static RoughThree load(const float* p) { return {load4(p)}; }
  void store(float* p) const { store4(p, value); }
  void add(float l, RoughThree y) { value += splat4(l) * y.value; }
  void subtract(RoughThree y) { value -= y.value; }
};

/// y <- L11^-1 y (columns rows), then below <- L21 y (rows - columns rows).
template <class Lanes>
void forward_panel(const typename Lanes::Scalar* panel, int rows, int columns, typename Lanes::Scalar* y,
                   typename Lanes::Scalar* below);

/// y <- L11^-T (y - L21' below).
template <class Lanes>
void backward_panel(const typename Lanes::Scalar* panel, int rows, int columns, typename Lanes::Scalar* y,
                    const typename Lanes::Scalar* below);

}  // namespace pliant::dense
