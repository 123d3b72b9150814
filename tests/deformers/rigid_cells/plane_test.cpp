// Rigid cells in the plane.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "pliant/deformers/rigid_cells/deformer.h"
#include "support/edits.h"

using namespace pliant;

namespace {

/// A bar 4 x 1 in the plane, its left end fixed and its right one turned and moved.
struct Bar {
  std::shared_ptr<const Shape> shape;
  std::unique_ptr<RigidCells> deformer;

  explicit Bar(const RigidCellsOptions& options) {
    constexpr std::uint32_t kAlong = 81, kAcross = 21;
    std::vector<double> places;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t y = 0; y < kAcross; ++y) {
      for (std::uint32_t x = 0; x < kAlong; ++x) {
        places.insert(places.end(), {0.05 * x, 0.05 * y});
        if (x + 1 == kAlong || y + 1 == kAcross) continue;
        const std::uint32_t a = y * kAlong + x, b = a + kAlong;
        triangles.insert(triangles.end(), {a, a + 1, b, a + 1, b + 1, b});
      }
    }
    shape = *Shape::create(places, triangles, 2);
    deformer = std::move(*RigidCells::create(shape, options));
    std::vector<Index> left, right;
    for (Index v = 0; v < static_cast<Index>(kAlong * kAcross); ++v) {
      if (places[2 * v] < 0.2) left.push_back(v);
      if (places[2 * v] > 3.8) right.push_back(v);
    }
    REQUIRE(deformer->set_fixed(left).ok());
    const auto handle = deformer->add_handle(right);
    REQUIRE(handle.ok());
    REQUIRE(deformer->move_handle(*handle, test::turn(100, {0, 0, 1}, {3.9, 0.5, 0}, {-1.2, 1.4, 0})).ok());
    do {
      test::settle(*deformer, 300, 1e-9);
    } while (*deformer->refine() > 0);
  }
  std::size_t cells() const { return deformer->save().find("cells[]/size")->data.size(); }
};

}  // namespace

TEST_CASE("a few cells where they matter do what a dense grid does (the paper's figure 7)") {
  const Bar dense({.resolution = 80, .boundary_levels = 0});
  const Bar adaptive({.resolution = 20, .boundary_levels = 0, .refine = true});
  const Bar coarse({.resolution = 20, .boundary_levels = 0});
  CHECK(4 * adaptive.cells() <= dense.cells());
  CHECK(adaptive.cells() > coarse.cells());
  const Points reference = dense.deformer->positions();
  const double moved = (reference - dense.shape->points()).norm();
  const double error = (adaptive.deformer->positions() - reference).norm() / moved;
  CHECK(error < 0.05);
  CHECK(error < (coarse.deformer->positions() - reference).norm() / moved);
}

TEST_CASE("in the plane cells turn about its normal alone") {
  const Bar bar({.resolution = 10});
  const State state = bar.deformer->save();
  const std::vector<double>& rotations = state.find("cells[]/rotation")->data;
  for (std::size_t c = 0; c < rotations.size(); c += 9) {
    for (const int k : {2, 5, 6, 7}) CHECK(rotations[c + k] == 0.0);
    CHECK(rotations[c + 8] == doctest::Approx(1.0).epsilon(1e-14));
  }
}
