// What deformers with a constant matrix share: when they are at rest, and what they leave alone.
#include "pliant/solve/local_global_deformer.h"

#include <doctest/doctest.h>

#include "pliant/deformers/registry.h"
#include "support/edits.h"

using namespace pliant;

namespace {

struct Kind {
  const char* method;
  double smoothness;
};
constexpr Kind kKinds[] = {{"arap", 0.0}, {"arap", 0.05}, {"edge-material", 0.0}};

std::unique_ptr<Deformer> deformer_of(const Kind& kind, const test::Mesh& mesh) {
  NamedValues options;
  if (kind.smoothness > 0.0) options.push_back({"smoothness", "", {kind.smoothness}});
  auto deformer = build_deformer(kind.method, test::shape_of(mesh), options);
  REQUIRE(deformer.ok());
  return std::move(*deformer);
}

}  // namespace

TEST_CASE("local-global: at rest the shape is as near to the minimum as the tolerance says") {
  // Steps that shrink slowly: where one is below the tolerance, many like it may still come.
  const test::Mesh mesh = test::tube(24, 120, 0.25, 6.0);
  for (const Kind& kind : kKinds) {
    CAPTURE(std::string(kind.method));
    CAPTURE(kind.smoothness);
    const auto deformer = deformer_of(kind, mesh);
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    for (double tolerance : {1e-4, 1e-5, 1e-6}) {
      deformer->reset();
      REQUIRE(deformer->move_handle(handle, test::turn(57, {1, 0.5, 0}, {0, 0, 5.4}, {0.3, 0.6, -0.3})).ok());
      CHECK(test::settle(*deformer, 500, tolerance).converged);
      const Points here = deformer->positions();
      test::settle(*deformer, 3000, 1e-12);
      CHECK(test::distance(deformer->positions(), here) < 3.0 * tolerance * deformer->shape().diagonal());
    }
  }
}

TEST_CASE("local-global: a loose part that nobody touches stays where it is, however long one drags") {
  // An energy that no turn of it changes does not hold it against rounding, which grew with every step of the others.
  const test::Mesh tube = test::tube(12, 20, 0.25, 2.0);
  const test::Mesh loose = test::transformed(test::potato(2), 0.1, Eigen::Matrix3d::Identity(), {0.3, 0.4, 1.1});
  const test::Mesh mesh = test::both(tube, loose);
  for (const Kind& kind : kKinds) {
    CAPTURE(std::string(kind.method));
    CAPTURE(kind.smoothness);
    const auto deformer = deformer_of(kind, mesh);
    const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
    for (int i = 1; i <= 60; ++i) {
      REQUIRE(deformer->move_handle(handle, test::turn(1.5 * i, {1, 0, 0}, {0, 0, 1.9}, {0, 0.01 * i, 0})).ok());
      for (int k = 0; k < 3; ++k) REQUIRE(deformer->step().ok());
    }
    const Points now = deformer->positions();
    for (Index v = tube.vertices(); v < mesh.vertices(); ++v) CHECK(now.col(v) == mesh.vertex(v));
  }
}
