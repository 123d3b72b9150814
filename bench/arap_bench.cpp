// ARAP against the plain local-global loop: same build, same model, same factor, same start. The
// loop is the step kernel with an empty memory, which makes every step the classic one.
#include "bench.h"
#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/arap/model.h"
#include "pliant/solve/local_global.h"
#include "pliant/solve/run.h"
#include "surface_scene.h"

namespace pliant::bench {
namespace {

std::unique_ptr<Arap> deformer_of(const SurfaceScene& scene, ArapEnergy energy) {
  auto deformer = std::move(Arap::create(scene.shape, {.energy = energy}).value());
  scene.grab(*deformer);
  return deformer;
}

struct Plain {
  double to_enough = 0.0;  ///< ms, factorisation not counted
  double step = 0.0;
  int iterations = 0;
};

/// From rest with the deformer's handles where they should be, on its own numbering.
Plain plain_loop(const Arap& deformer, ArapEnergy energy, double enough) {
  const Shape& shape = deformer.shape();
  arap::ArapModel model(shape, {.energy = energy});
  Points x = shape.points();
  std::vector<bool> held(x.cols(), false);
  for (Index p : deformer.fixed_points()) held[p] = true;
  for (const Handle& handle : deformer.handles()) {
    for (Index p : handle.points) held[p] = true;
    x(Eigen::all, handle.points) = handle.targets;
  }
  LocalGlobal loop;
  if (!loop.set_up(model.matrix(), held).ok()) std::abort();
  Plain plain;
  const double start = now();
  do {
    loop.forget();
    ++plain.iterations;
    if (!loop.step(model, x, 1e-12, shape.diagonal(), 0.0).accepted) break;
  } while (loop.energy() > enough);
  plain.to_enough = now() - start;
  plain.step = plain.to_enough / plain.iterations;
  return plain;
}

void bench_energy(const Reporter& reporter, ArapEnergy energy, const std::string& name) {
  if (!reporter.wants(name)) return;
  const SurfaceScene scene(test::torus(170, 64));
  const auto deformer = deformer_of(scene, energy);
  const double grab = [&] {
    const double start = now();
    if (!deformer->step().ok()) std::abort();
    return now() - start;
  }();
  reporter.report(name + " grab: analyse, factorise, 10,880 vertices", grab);

  scene.drag(*deformer);
  if (!run(*deformer, {1000, 1e-12}).ok()) std::abort();
  const double enough = deformer->energy().total * (1.0 + 1e-4);
  deformer->reset();
  scene.drag(*deformer);
  double elapsed = 0.0, reached = 0.0;
  int iterations = 0;
  do {
    const double start = now();
    reached = deformer->step(1e-12)->energy;
    elapsed += now() - start;
    ++iterations;
  } while (reached > enough && iterations < 1000);

  const Plain plain = plain_loop(*deformer, energy, enough);
  reporter.report(name + " plain loop to 1e-4", plain.to_enough, 0.0, std::to_string(plain.iterations) + " iterations");
  reporter.report(name + " cold to 1e-4", elapsed, plain.to_enough, std::to_string(iterations) + " iterations");
  reporter.report(name + " step", elapsed / iterations, plain.step);
}

}  // namespace

static void bench_arap(const Reporter& reporter) {
  bench_energy(reporter, ArapEnergy::spokes, "arap spokes");
  bench_energy(reporter, ArapEnergy::spokes_and_rims, "arap rims");
}

namespace {
const Bench bench(bench_arap);
}

}  // namespace pliant::bench
