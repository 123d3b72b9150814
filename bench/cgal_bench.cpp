// ARAP beside CGAL's Surface_mesh_deformation (spokes and rims, the same energy). Built only where
// CGAL is found; nothing else in Pliant needs it.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <functional>
#include <numeric>

#include "bench.h"
#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/arap/model.h"
#include "pliant/solve/run.h"
#include "surface_scene.h"

namespace pliant::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Deformation = CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS>;

/// CGAL gives up settling after this many iterations.
constexpr int kPatience = 600;
/// Steps of either before it is the other's turn.
constexpr int kTurn = 8;

Mesh cgal_mesh(const test::Mesh& from) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (Index v = 0; v < from.vertices(); ++v) {
    const Eigen::Vector3d p = from.vertex(v);
    vertices.push_back(mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  }
  for (std::size_t t = 0; t < from.triangles.size(); t += 3) {
    mesh.add_face(vertices[from.triangles[t]], vertices[from.triangles[t + 1]], vertices[from.triangles[t + 2]]);
  }
  return mesh;
}

Points points_of(const Mesh& mesh) {
  Points points(3, static_cast<Index>(mesh.number_of_vertices()));
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    points.col(static_cast<Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  return points;
}

/// Their side of the comparison: the same grab, the same drag, one iteration at a time.
class Theirs {
 public:
  explicit Theirs(const SurfaceScene& scene) : mesh_(cgal_mesh(scene.mesh)), deformation_(mesh_), scene_(scene) {
    for (const auto v : mesh_.vertices()) deformation_.insert_roi_vertex(v);
    for (const auto* list : {&scene.fixed, &scene.moved}) {
      for (Index v : *list) deformation_.insert_control_vertex(Mesh::Vertex_index(v));
    }
  }
  void factorise() {
    if (!deformation_.preprocess()) std::abort();
  }
  void drag() {
    for (Index v : scene_.moved) {
      const Eigen::Vector3d p = scene_.motion.apply(scene_.mesh.vertex(v));
      deformation_.set_target_position(Mesh::Vertex_index(v), Kernel::Point_3(p.x(), p.y(), p.z()));
    }
  }
  void step() { deformation_.deform(1, 0.0); }
  double energy() {
    Points unused;
    return model_.evaluate(points_of(mesh_), unused);
  }

 private:
  Mesh mesh_;
  Deformation deformation_;
  const SurfaceScene& scene_;
  arap::ArapModel model_{*scene_.shape, {.energy = ArapEnergy::spokes_and_rims}};
};

double timed(const std::function<void()>& call) {
  const double start = now();
  call();
  return now() - start;
}

}  // namespace

static void bench_cgal(const Reporter& reporter) {
  if (!reporter.wants("arap against CGAL")) return;
  const SurfaceScene scene(test::torus(170, 64));
  const auto ours = std::move(Arap::create(scene.shape, {.energy = ArapEnergy::spokes_and_rims}).value());
  Theirs theirs(scene);
  scene.grab(*ours);
  const double our_factor = timed([&] {
    if (!ours->step().ok()) std::abort();
  });
  const double their_factor = timed([&] { theirs.factorise(); });

  scene.drag(*ours);
  if (!run(*ours, {1000, 1e-12}).ok()) std::abort();
  const double enough = ours->energy().total * (1.0 + 1e-4);
  ours->reset();
  scene.drag(*ours);
  theirs.drag();
  // In turns, since a shared machine does not keep its speed; of several steps each, since neither
  // should find its cache full of the other's numbers at every step.
  std::vector<double> our_steps, their_steps;
  for (double energy = 2.0 * enough; energy > enough;) {
    for (int i = 0; i < kTurn && energy > enough; ++i)
      our_steps.push_back(timed([&] { energy = ours->step(1e-12)->energy; }));
    for (int i = 0; i < kTurn; ++i) their_steps.push_back(timed([&] { theirs.step(); }));
  }
  const double our_settled = std::accumulate(our_steps.begin(), our_steps.end(), 0.0);
  double their_settled = std::accumulate(their_steps.begin(), their_steps.end(), 0.0);
  int iterations = static_cast<int>(their_steps.size());
  for (; iterations < kPatience && theirs.energy() > enough; ++iterations)
    their_settled += timed([&] { theirs.step(); });
  reporter.report("arap against CGAL: analyse and factorise", our_factor, their_factor);
  reporter.report("arap against CGAL: step", median(our_steps), median(their_steps));
  reporter.report("arap against CGAL: settled to 1e-4", our_settled, their_settled,
                  iterations < kPatience ? "CGAL: " + std::to_string(iterations) + " iterations"
                                         : "CGAL not there after " + std::to_string(kPatience) + " iterations");
}

namespace {
const Bench bench(bench_cgal);
}

}  // namespace pliant::bench
