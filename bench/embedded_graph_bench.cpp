// The embedded graph against its yardsticks, all from one run:
// - solving: one factorisation by Eigen's SimplicialLLT of a 12 x 12-block system over random nodes
// on
//   a sphere with six symmetrised neighbours;
// - carrying: the plain loop of eq. 2 over the same data.
#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include <Eigen/SparseCholesky>

#include "bench.h"
#include "pliant/deformers/embedded_graph/deformer.h"
#include "pliant/deformers/embedded_graph/graph.h"
#include "pliant/solve/carry.h"
#include "pliant/solve/run.h"
#include "support/shapes.h"

namespace pliant::bench {
namespace {

std::vector<Index> pick(const test::Mesh& mesh, double low, double high) {
  std::vector<Index> picked;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    const double x = mesh.vertex(v).x();
    if (x >= low && x <= high) picked.push_back(v);
  }
  return picked;
}

/// `count` of the candidates, evenly.
std::vector<Index> every(const std::vector<Index>& candidates, std::size_t count) {
  std::vector<Index> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(candidates[i * candidates.size() / count]);
  return some;
}

Eigen::SparseMatrix<double> yardstick_matrix(Index nodes) {
  constexpr int kBlock = 12, kNeighbours = 6;
  std::mt19937 random(1);
  auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  Points p(3, nodes);
  for (Index j = 0; j < nodes; ++j) {
    do p.col(j) << number(), number(), number();
    while (p.col(j).squaredNorm() > 1.0);
    p.col(j).normalize();
  }
  std::set<Edge> edges;
  for (Index j = 0; j < nodes; ++j) {
    std::vector<std::pair<double, Index>> order;
    for (Index k = 0; k < nodes; ++k) {
      if (k != j) order.push_back({(p.col(k) - p.col(j)).squaredNorm(), k});
    }
    std::partial_sort(order.begin(), order.begin() + kNeighbours, order.end());
    for (int s = 0; s < kNeighbours; ++s) {
      edges.insert({std::min(j, order[s].second), std::max(j, order[s].second)});
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < nodes * kBlock; ++i) entries.emplace_back(i, i, 200.0);
  for (const auto& [j, k] : edges) {
    for (int r = 0; r < kBlock; ++r) {
      for (int c = 0; c < kBlock; ++c) entries.emplace_back(k * kBlock + r, j * kBlock + c, number());
    }
  }
  Eigen::SparseMatrix<double> matrix(nodes * kBlock, nodes * kBlock);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// One factorisation of the yardstick's matrix, timed again and again between what is measured
/// with it: machines that others use, too, do not keep their speed.
class Yardstick {
 public:
  explicit Yardstick(Index nodes) : matrix_(yardstick_matrix(nodes)) {
    llt_.analyzePattern(matrix_);
    llt_.factorize(matrix_);
  }
  void sample() {
    const double start = now();
    llt_.factorize(matrix_);
    times_.push_back(now() - start);
  }
  /// Of the samples since the last call.
  double take_median() { return median(std::exchange(times_, {})); }

 private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt_;
  std::vector<double> times_;
};

/// One grab: a torus of 85,792 vertices, one side fixed, the other turned by 60 degrees and moved.
class Scene {
 public:
  explicit Scene(EmbeddedGraphOptions options) : mesh_(test::torus(383, 224)), options_(std::move(options)) {
    shape_ = *Shape::create(mesh_.positions, mesh_.triangles);
  }

  std::unique_ptr<EmbeddedGraph> grabbed(std::vector<Index> moved = {}) const {
    auto deformer = std::move(EmbeddedGraph::create(shape_, options_).value());
    if (moved.empty()) moved = pick(mesh_, 1.1, 9.0);
    if (!deformer->set_fixed(pick(mesh_, -9.0, -1.1)).ok() || !deformer->add_handle(moved).ok()) std::abort();
    return deformer;
  }
  static void drag(EmbeddedGraph& deformer, double part) {
    Motion motion;
    motion.axis = {0.2, 1.0, 0.1};
    motion.angle = part * 1.05;
    motion.about = {1, 0, 0};
    motion.translation = part * Eigen::Vector3d(-0.3, 0.1, 0.4);
    if (!deformer.move_handle(1, motion).ok()) std::abort();
  }
  const test::Mesh& mesh() const { return mesh_; }
  const Shape& shape() const { return *shape_; }

 private:
  test::Mesh mesh_;
  EmbeddedGraphOptions options_;
  std::shared_ptr<const Shape> shape_;
};

double step_ms(EmbeddedGraph& deformer) {
  const double start = now();
  if (!deformer.step(1e-12).ok()) std::abort();
  return now() - start;
}

double converged_energy(const Scene& scene, const std::vector<Index>& moved) {
  const auto deformer = scene.grabbed(moved);
  Scene::drag(*deformer, 1.0);
  if (!run(*deformer, {500, 1e-13}).ok()) std::abort();
  return deformer->energy().total;
}

/// From the first step after a grab (analysis and factorisation included) to within 1e-4 of `energy`.
double cold_ms(const Scene& scene, const std::vector<Index>& moved, double energy, Yardstick& yardstick,
               int& iterations) {
  const double enough = energy * (1.0 + 1e-4);
  std::vector<double> times;
  for (int i = 0; i < 15; ++i) {
    const auto deformer = scene.grabbed(moved);
    Scene::drag(*deformer, 1.0);
    yardstick.sample();
    double elapsed = 0.0;
    for (iterations = 1; iterations < 500; ++iterations) {
      const double start = now();
      const auto report = deformer->step(1e-12);
      elapsed += now() - start;
      if (report->energy <= enough) break;
    }
    times.push_back(elapsed);
  }
  return median(std::move(times));
}

/// One step a frame while the handle moves on.
double warm_ms(const Scene& scene, std::vector<Index> moved = {}, Yardstick* yardstick = nullptr) {
  const auto deformer = scene.grabbed(std::move(moved));
  std::vector<double> times;
  for (int frame = 1; frame <= 60; ++frame) {
    Scene::drag(*deformer, frame / 60.0);
    const double ms = step_ms(*deformer);
    if (frame > 5) times.push_back(ms);
    if (yardstick != nullptr && frame % 5 == 0) yardstick->sample();
  }
  return median(std::move(times));
}

void bench_solving(const Reporter& reporter, Index nodes) {
  const std::string name = "embedded-graph/" + std::to_string(nodes);
  if (!reporter.wants(name)) return;
  Yardstick yardstick(nodes);
  const Scene scene({.node_count = nodes});
  const Scene newton({.node_count = nodes, .solver = EmbeddedGraphSolver::gauss_newton});
  // The paper's 27 constraints (table 1), and a handle as a page makes them: every vertex of a
  // part.
  for (std::size_t count : {std::size_t{27}, std::size_t{4727}}) {
    const std::vector<Index> moved = every(pick(scene.mesh(), 1.1, 9.0), count);
    const std::string constraints = ", " + std::to_string(moved.size()) + " constraints";
    int iterations = 0;
    // The better of both solvers: one that stalls must not be its own measure.
    const double energy = std::min(converged_energy(scene, moved), converged_energy(newton, moved));
    const double cold = cold_ms(scene, moved, energy, yardstick, iterations);
    reporter.report(name + " cold solve to 1e-4" + constraints, cold, yardstick.take_median(),
                    std::to_string(iterations) + " iterations");
    const double warm = warm_ms(scene, moved, &yardstick);
    reporter.report(name + " warm step" + constraints, warm, yardstick.take_median());
  }
  const double step = warm_ms(newton, {}, &yardstick);
  reporter.report(name + " Gauss-Newton step", step, yardstick.take_median());
}

void bench_constraints(const Reporter& reporter) {
  if (!reporter.wants("embedded-graph constraints")) return;
  for (auto solver : {EmbeddedGraphSolver::automatic, EmbeddedGraphSolver::gauss_newton}) {
    const Scene scene({.node_count = 221, .solver = solver});
    const std::vector<Index> candidates = pick(scene.mesh(), 0.7, 9.0);
    const std::string name = std::string("embedded-graph constraints ") +
                             (solver == EmbeddedGraphSolver::automatic ? "auto" : "Gauss-Newton");
    const double few = warm_ms(scene, every(candidates, 13));
    for (int count : {670, 1900, 5000}) {
      reporter.report(name + " " + std::to_string(count) + " against 13", warm_ms(scene, every(candidates, count)),
                      few);
    }
  }
}

void bench_frozen(const Reporter& reporter) {
  if (!reporter.wants("embedded-graph frozen")) return;
  for (auto solver : {EmbeddedGraphSolver::automatic, EmbeddedGraphSolver::gauss_newton}) {
    const Scene scene({.node_count = 840, .solver = solver});
    auto timed = [&](double fixed_to) {
      const auto deformer = scene.grabbed();
      if (!deformer->set_fixed(pick(scene.mesh(), -9.0, fixed_to)).ok()) std::abort();
      std::vector<double> times;
      for (int frame = 1; frame <= 25; ++frame) {
        Scene::drag(*deformer, frame / 60.0);
        const double ms = step_ms(*deformer);
        if (frame > 5) times.push_back(ms);
      }
      return std::pair(median(std::move(times)), deformer->counters().unknowns / 12);
    };
    const auto [all, all_nodes] = timed(-1.29);
    const auto [few, few_nodes] = timed(0.75);
    reporter.report(std::string("embedded-graph frozen ") +
                        (solver == EmbeddedGraphSolver::automatic ? "auto " : "Gauss-Newton ") +
                        std::to_string(few_nodes) + " of 840 nodes against " + std::to_string(all_nodes),
                    few, all);
  }
}

/// Eq. 2 as anyone would write it.
void plain_carry(const std::vector<double>& maps, const Influences& influences, const Points& points,
                 std::vector<double>& out) {
  for (Index i = 0; i < points.cols(); ++i) {
    double x = 0, y = 0, z = 0;
    const double px = points(0, i), py = points(1, i), pz = points(2, i);
    for (int s = 0; s < 4; ++s) {
      const double* m = &maps[12 * influences.indices[4 * i + s]];
      const double w = influences.weights[4 * i + s];
      x += w * (m[0] * px + m[1] * py + m[2] * pz + m[3]);
      y += w * (m[4] * px + m[5] * py + m[6] * pz + m[7]);
      z += w * (m[8] * px + m[9] * py + m[10] * pz + m[11]);
    }
    out[3 * i] = x;
    out[3 * i + 1] = y;
    out[3 * i + 2] = z;
  }
}

void bench_carrying(const Reporter& reporter) {
  if (!reporter.wants("embedded-graph carry")) return;
  const Scene scene({.node_count = 226});
  const EmbeddedGraphOptions options{.node_count = 226};
  const DeformationGraph graph = build_graph(scene.shape(), *place_nodes(scene.shape(), options), options);
  std::mt19937 random(5);
  std::vector<double> plain_maps(12 * 226);
  for (double& v : plain_maps) v = static_cast<double>(random()) / 4294967296.0;
  PackedMaps maps(12, 226);
  for (Index j = 0; j < 226; ++j) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> m(&plain_maps[12 * j]);
    maps.col(j) = pack_map(m.leftCols<3>(), m.col(3));
  }
  Points out(3, scene.shape().points().cols());
  std::vector<double> plain_out(out.size());
  std::vector<double> ours, plain;
  for (int i = 0; i < 41; ++i) {
    double start = now();
    carry(maps, graph.influences, scene.shape().points(), Eigen::Vector3d::Zero(), out);
    ours.push_back(now() - start);
    start = now();
    plain_carry(plain_maps, graph.influences, scene.shape().points(), plain_out);
    plain.push_back(now() - start);
  }
  const double yard = median(std::move(plain));
  reporter.report("embedded-graph carry 85,792 vertices, plain loop", yard);
  reporter.report("embedded-graph carry 85,792 vertices", median(std::move(ours)), yard);
  const auto deformer = scene.grabbed();
  Scene::drag(*deformer, 1.0);
  if (!run(*deformer).ok()) std::abort();
  reporter.report("embedded-graph positions of 85,792 vertices", median_ms(15, [&] { out = deformer->positions(); }),
                  yard);
  reporter.report("embedded-graph normals of 85,792 vertices", median_ms(15, [&] { out = deformer->normals(); }), yard);
}

void bench_building(const Reporter& reporter) {
  for (Index nodes : {226, 1048}) {
    const std::string name = "embedded-graph/" + std::to_string(nodes) + " build graph";
    if (!reporter.wants(name)) continue;
    const Scene scene({.node_count = nodes});
    reporter.report(name, median_ms(3, [&] { (void)scene.grabbed(); }));
  }
}

}  // namespace

static void bench_embedded_graph(const Reporter& reporter) {
  bench_solving(reporter, 226);
  bench_solving(reporter, 1048);
  bench_constraints(reporter);
  bench_frozen(reporter);
  bench_carrying(reporter);
  bench_building(reporter);
}

namespace {
const Bench bench(bench_embedded_graph);
}

}  // namespace pliant::bench
