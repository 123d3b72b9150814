// Rigid cells: a Newton step beside one direct factorisation of the same system by Eigen (the paper:
// 260 ms at 1,176 cells, 1,660 ms at 5,518), and a frame of 43,000 vertices.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "bench.h"
#include "pliant/deformers/rigid_cells/deformer.h"
#include "pliant/deformers/rigid_cells/model.h"
#include "pliant/solve/run.h"
#include "surface_scene.h"

namespace pliant::bench {
namespace {

/// The Newton system at rest, all cells free but for a little of each block's own.
Eigen::SparseMatrix<double> newton_system(const Shape& shape, const RigidCellsOptions& options) {
  const cells::CellTree tree = std::move(*cells::CellTree::create(shape, options));
  const cells::CellModel model = cell_model(tree, shape, std::vector<double>(shape.points().cols(), 1.0));
  const std::vector<cells::CellMotion> motions = model.rest();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index i, Index j, const Eigen::Matrix<double, 6, 6>& block) {
    for (int c = 0; c < 6; ++c) {
      for (int r = 0; r < 6; ++r) entries.emplace_back(6 * i + r, 6 * j + c, block(r, c));
    }
  };
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const auto [i, j] = model.pairs[p];
    cells::Inertia inertia;
    double unused[12] = {};
    model.glue[p].linearize(motions[i], motions[j], inertia, unused, unused + 6);
    const Eigen::Matrix<double, 6, 6> block = inertia.dense();
    add(i, i, 1.001 * block);
    add(j, j, 1.001 * block);
    add(j, i, -block);
  }
  Eigen::SparseMatrix<double> system(6 * model.size(), 6 * model.size());
  system.setFromTriplets(entries.begin(), entries.end());
  return system;
}

void bench_step(const Reporter& reporter, int resolution, int factorizations) {
  const std::string name = "rigid-cells/" + std::to_string(resolution);
  if (!reporter.wants(name)) return;
  const SurfaceScene scene(test::torus(240, 180));
  const RigidCellsOptions options{.resolution = resolution};
  double start = now();
  const auto deformer = std::move(*RigidCells::create(scene.shape, options));
  const double build = now() - start;
  scene.grab(*deformer);
  std::vector<double> steps, frames;
  for (int frame = 1; frame <= 40; ++frame) {
    scene.drag(*deformer, frame / 40.0);
    start = now();
    if (!deformer->step(1e-12).ok()) std::abort();
    steps.push_back(now() - start);
    start = now();
    const Points carried = deformer->point_positions();
    frames.push_back(now() - start);
  }
  const double first = frames.front();
  const std::string cells = std::to_string(deformer->save().find("cells[]/size")->data.size()) + " cells";
  std::vector<double> direct;
  if (factorizations > 0) {
    const Eigen::SparseMatrix<double> system = newton_system(*scene.shape, options);
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> eigen;
    eigen.analyzePattern(system);
    for (int i = 0; i < factorizations; ++i) {
      start = now();
      eigen.factorize(system);
      direct.push_back(now() - start);
    }
  }
  reporter.report(name + " build, 43,200 vertices", build, 0.0, cells);
  reporter.report(name + " step", median(steps), direct.empty() ? 0.0 : median(direct), cells);
  reporter.report(name + " first frame: samples of the map, 43,200 vertices", first);
  reporter.report(name + " carry 43,200 vertices", median(frames), 1000.0 / 60.0, "yardstick: a 60th of a second");
}

void bench_to_rest(const Reporter& reporter) {
  if (!reporter.wants("rigid-cells to rest")) return;
  const SurfaceScene scene(test::torus(120, 60));
  const auto deformer = std::move(*RigidCells::create(scene.shape, {.resolution = 16}));
  scene.grab(*deformer);
  scene.drag(*deformer);
  const double start = now();
  const auto report = run(*deformer, {100, 1e-6});
  reporter.report("rigid-cells to rest after a turn of 60 degrees", now() - start, 0.0,
                  std::to_string(report->iteration) + " iterations");
}

}  // namespace

static void bench_rigid_cells(const Reporter& reporter) {
  bench_step(reporter, 14, 3);
#ifdef __EMSCRIPTEN__
  bench_step(reporter, 28, 0);
#else
  bench_step(reporter, 28, 1);
#endif
  bench_to_rest(reporter);
}

namespace {
const Bench bench(bench_rigid_cells);
}

}  // namespace pliant::bench
