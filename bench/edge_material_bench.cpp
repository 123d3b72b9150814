// Material-aware edges: the plane of the paper's table 1 (10,201 vertices: 510 ms to factorise, 65
// ms to substitute back, 190 ms a frame), and how soon it settles beside steps without memory.
#include "bench.h"
#include "pliant/deformers/edge_material/deformer.h"
#include "pliant/solve/run.h"
#include "surface_scene.h"

namespace pliant::bench {
namespace {

std::unique_ptr<EdgeMaterial> plane() {
  const test::Mesh mesh = test::plane_grid(101, 101);
  const auto shape = *Shape::create(mesh.positions, mesh.triangles);
  auto deformer = std::move(EdgeMaterial::create(shape, {.lambda = 1e-3}).value());
  if (!deformer->set_fixed(std::vector<Index>{0, 100, 10100, 10200}).ok()) std::abort();
  if (!deformer->add_handle(std::vector<Index>{5100}).ok()) std::abort();
  return deformer;
}

void lift(EdgeMaterial& deformer, double by) {
  Motion motion;
  motion.translation = {0, 0, by};
  if (!deformer.move_handle(1, motion).ok()) std::abort();
}

void bench_plane(const Reporter& reporter) {
  if (!reporter.wants("edge-material plane")) return;
  auto deformer = plane();
  double start = now();
  if (!deformer->step().ok()) std::abort();
  reporter.report("edge-material plane grab: analyse, factorise, 10,201 vertices", now() - start);
  EdgeMaterialOptions options = deformer->options();
  options.lambda = 2e-3;
  if (!deformer->set_options(options).ok()) std::abort();
  start = now();
  if (!deformer->step().ok()) std::abort();
  reporter.report("edge-material plane another lambda: factorise", now() - start);

  lift(*deformer, 0.3);
  start = now();
  const auto report = run(*deformer, {500, 1e-6});
  reporter.report("edge-material plane lifted, to rest", now() - start, 0.0,
                  std::to_string(report->iteration) + " iterations");
  std::vector<double> times;
  for (int frame = 0; frame < 60; ++frame) {
    lift(*deformer, 0.3 + 0.002 * frame);
    start = now();
    if (!deformer->step(1e-12).ok()) std::abort();
    times.push_back(now() - start);
  }
  reporter.report("edge-material plane frame of a drag", median(std::move(times)));
}

void bench_torus(const Reporter& reporter) {
  if (!reporter.wants("edge-material torus")) return;
  const SurfaceScene scene(test::torus(170, 64));
  auto deformer = std::move(EdgeMaterial::create(scene.shape, {}).value());
  scene.grab(*deformer);
  double start = now();
  if (!deformer->step().ok()) std::abort();
  reporter.report("edge-material torus grab, 10,880 vertices", now() - start);
  scene.drag(*deformer);
  start = now();
  const auto report = run(*deformer, {500, 1e-6});
  reporter.report("edge-material torus bent, to rest", now() - start, 0.0,
                  std::to_string(report->iteration) + " iterations");
}

}  // namespace

static void bench_edge_material(const Reporter& reporter) {
  bench_plane(reporter);
  bench_torus(reporter);
}

namespace {
const Bench bench(bench_edge_material);
}

}  // namespace pliant::bench
