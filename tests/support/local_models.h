// What every LocalModel promises of its matrix.
#pragma once

#include <algorithm>

#include <doctest/doctest.h>

#include "pliant/solve/local_model.h"
#include "support/dense.h"

namespace pliant::test {

/// With all rotations at zero the half gradient at x is the matrix times x, to a relative
/// `tolerance`; the matrix's edges are sorted.
inline void check_matrix_is_second_derivative(const LocalModel& model, const Points& x, double tolerance) {
  const BlockMatrix matrix = model.matrix();
  CHECK(std::is_sorted(matrix.edges.begin(), matrix.edges.end()));
  Points half_gradient;
  model.turned_gradient(x, Rotations::Zero(9, x.cols()), x, half_gradient);
  CHECK((half_gradient - x * dense(matrix)).norm() < tolerance * half_gradient.norm());
}

}  // namespace pliant::test
