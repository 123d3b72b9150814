#include "sketch/sketch_support.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace pliant::test {

Mesh cylinder(int around, int along, double radius) {
  Mesh mesh = tube(around, along, radius, 1.0);
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices());
  mesh.positions.insert(mesh.positions.end(), {0.0, 0.0, 0.0, 0.0, 0.0, 1.0});
  const auto last = static_cast<std::uint32_t>((along - 1) * around);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(around); ++i) {
    const std::uint32_t next = (i + 1) % around;
    mesh.triangles.insert(mesh.triangles.end(), {bottom, next, i});
    mesh.triangles.insert(mesh.triangles.end(), {bottom + 1, last + i, last + next});
  }
  return mesh;
}

Mesh cells(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid) {
  const auto holds = [&](const Eigen::Vector3i& c) {
    return (c.array() >= 0).all() && c.x() < nx && c.y() < ny && c.z() < nz && solid(c.x(), c.y(), c.z());
  };
  Mesh mesh;
  for (int i = 0; i < nx * ny * nz; ++i) {
    const Eigen::Vector3i cell(i % nx, i / nx % ny, i / nx / ny);
    if (!holds(cell)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int far : {0, 1}) {
        Eigen::Vector3i other = cell;
        other[axis] += far ? 1 : -1;
        if (holds(other)) continue;
        const auto first = static_cast<std::uint32_t>(mesh.vertices());
        for (int corner = 0; corner < 4; ++corner) {
          Eigen::Vector3i p = cell;
          p[axis] += far;
          p[(axis + 1) % 3] += (corner == 1 || corner == 2);
          p[(axis + 2) % 3] += corner >= 2;
          for (const int x : p) mesh.positions.push_back(x);
        }
        const std::uint32_t b = first + (far ? 1 : 3), d = first + (far ? 3 : 1);
        mesh.triangles.insert(mesh.triangles.end(), {first, b, first + 2, first, first + 2, d});
      }
    }
  }
  return mesh;
}

CameraOptions front_view() {
  CameraOptions camera;
  camera.eye = {0.0, -5.0, 0.5};
  camera.target = {0.0, 0.0, 0.5};
  camera.up = {0.0, 0.0, 1.0};
  camera.orthographic_height = 2.0;
  camera.width = camera.height = 1000.0;
  return camera;
}

Eigen::Vector2d front_pixel(double x, double z) { return {500.0 + 500.0 * x, 750.0 - 500.0 * z}; }

Stroke straight(const Eigen::Vector2d& a, const Eigen::Vector2d& b, int samples) {
  Stroke stroke(2, samples);
  for (int i = 0; i < samples; ++i) stroke.col(i) = a + (b - a) * i / (samples - 1);
  return stroke;
}

Stroke curved(const Eigen::Vector2d& start, double length, const std::function<double(double)>& curvature,
              int samples) {
  Stroke stroke(2, samples);
  stroke.col(0) = start;
  double heading = std::numbers::pi / 2;
  const double step = length / (samples - 1);
  for (int i = 1; i < samples; ++i) {
    const double turn = step * curvature((i - 0.5) / (samples - 1));
    const double middle = heading + 0.5 * turn;
    // Pixels run downwards.
    stroke.col(i) = stroke.col(i - 1) + 500.0 * step * Eigen::Vector2d(std::cos(middle), -std::sin(middle));
    heading += turn;
  }
  return stroke;
}

std::unique_ptr<Sketch> sketch_on(const Mesh& mesh, const Stroke& reference, const SketchOptions& options,
                                  const CameraOptions& camera) {
  Result<Camera> seen = Camera::create(camera);
  REQUIRE_MESSAGE(seen.ok(), seen.status().message());
  Result<std::unique_ptr<Sketch>> sketch = Sketch::create(shape_of(mesh), *seen, reference, options);
  REQUIRE_MESSAGE(sketch.ok(), sketch.status().message());
  return std::move(*sketch);
}

Points point_positions(const Sketch& sketch) {
  return sketch.positions()(Eigen::all, sketch.shape().vertex_of_point());
}

Points positions_of(const Mesh& mesh) { return Eigen::Map<const Points>(mesh.positions.data(), 3, mesh.vertices()); }

double diagonal(const Mesh& mesh) {
  const Points points = positions_of(mesh);
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

}  // namespace pliant::test
