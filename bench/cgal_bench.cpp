// ARAP beside CGAL's Surface_mesh_deformation (spokes and rims, the same energy). Built only where
// CGAL is found; nothing else in Pliant needs it.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include "bench.h"
#include "pliant/deformers/arap/deformer.h"
#include "pliant/deformers/arap/model.h"
#include "pliant/solve/run.h"
#include "surface_scene.h"

namespace pliant::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Deformation =
    CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS>;

/// CGAL gives up settling after this many iterations.
constexpr int kPatience = 600;

Mesh cgal_mesh(const test::Mesh& from) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (Index v = 0; v < from.vertices(); ++v) {
    const Eigen::Vector3d p = from.vertex(v);
    vertices.push_back(mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  }
  for (std::size_t t = 0; t < from.triangles.size(); t += 3) {
    mesh.add_face(vertices[from.triangles[t]], vertices[from.triangles[t + 1]],
                  vertices[from.triangles[t + 2]]);
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

struct Times {
  double factorise = 0.0, step = 0.0, settled = 0.0;
  int iterations = 0;
};

Times measure_cgal(const SurfaceScene& scene, double enough) {
  Mesh mesh = cgal_mesh(scene.mesh);
  Deformation deformation(mesh);
  for (const auto v : mesh.vertices()) deformation.insert_roi_vertex(v);
  for (const auto* list : {&scene.fixed, &scene.moved}) {
    for (Index v : *list) deformation.insert_control_vertex(Mesh::Vertex_index(v));
  }
  Times times;
  double start = now();
  if (!deformation.preprocess()) std::abort();
  times.factorise = now() - start;
  for (Index v : scene.moved) {
    const Eigen::Vector3d p = scene.motion.apply(scene.mesh.vertex(v));
    deformation.set_target_position(Mesh::Vertex_index(v), Kernel::Point_3(p.x(), p.y(), p.z()));
  }
  arap::ArapModel model(*scene.shape, {.energy = ArapEnergy::spokes_and_rims});
  Points unused;
  for (times.iterations = 1; times.iterations < kPatience; ++times.iterations) {
    start = now();
    deformation.deform(1, 0.0);
    times.settled += now() - start;
    if (times.iterations % 5 == 0 && model.evaluate(points_of(mesh), unused) <= enough) break;
  }
  times.step = times.settled / times.iterations;
  return times;
}

Times measure_ours(const SurfaceScene& scene, double& enough) {
  const auto deformer =
      std::move(Arap::create(scene.shape, {.energy = ArapEnergy::spokes_and_rims}).value());
  scene.grab(*deformer);
  Times times;
  double start = now();
  if (!deformer->step().ok()) std::abort();
  times.factorise = now() - start;
  scene.drag(*deformer);
  if (!run(*deformer, {1000, 1e-12}).ok()) std::abort();
  enough = deformer->energy().total * (1.0 + 1e-4);
  deformer->reset();
  scene.drag(*deformer);
  double energy = 2.0 * enough;
  while (energy > enough) {
    start = now();
    energy = deformer->step(1e-12)->energy;
    times.settled += now() - start;
    ++times.iterations;
  }
  times.step = times.settled / times.iterations;
  return times;
}

}  // namespace

void bench_cgal(const Reporter& reporter) {
  if (!reporter.wants("arap against CGAL")) return;
  const SurfaceScene scene(test::torus(170, 64));
  double enough = 0.0;
  const Times ours = measure_ours(scene, enough);
  const Times theirs = measure_cgal(scene, enough);
  reporter.report("arap against CGAL: analyse and factorise", ours.factorise, theirs.factorise);
  reporter.report("arap against CGAL: step", ours.step, theirs.step);
  reporter.report("arap against CGAL: settled to 1e-4", ours.settled, theirs.settled,
                  theirs.iterations < kPatience
                      ? "CGAL: " + std::to_string(theirs.iterations) + " iterations"
                      : "CGAL not there after " + std::to_string(kPatience) + " iterations");
}

}  // namespace pliant::bench
