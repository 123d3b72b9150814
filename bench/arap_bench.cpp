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

Plain plain_loop(const SurfaceScene& scene, ArapEnergy energy, double enough) {
  arap::ArapModel model(*scene.shape, {.energy = energy});
  Points x = scene.shape->points();
  std::vector<bool> held(x.cols(), false);
  for (Index p : scene.fixed) held[p] = true;
  for (Index p : scene.moved) {
    held[p] = true;
    x.col(p) = scene.motion.apply(x.col(p));
  }
  LocalGlobal loop;
  if (!loop.set_up(model.matrix(), held).ok()) std::abort();
  Plain plain;
  const double start = now();
  do {
    loop.forget();
    ++plain.iterations;
    if (!loop.step(model, x, 1e-12, scene.shape->diagonal(), 0.0).accepted) break;
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

  const Plain plain = plain_loop(scene, energy, enough);
  reporter.report(name + " plain loop to 1e-4", plain.to_enough, 0.0,
                  std::to_string(plain.iterations) + " iterations");
  reporter.report(name + " cold to 1e-4", elapsed, plain.to_enough,
                  std::to_string(iterations) + " iterations");
  reporter.report(name + " step", elapsed / iterations, plain.step);
}

}  // namespace

void bench_arap(const Reporter& reporter) {
  bench_energy(reporter, ArapEnergy::spokes, "arap spokes");
  bench_energy(reporter, ArapEnergy::spokes_and_rims, "arap rims");
}

}  // namespace pliant::bench
