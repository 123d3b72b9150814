// A sketch on a tube of 100,000 vertices with strokes of 500 samples: choosing a limb, and the
// frames of a preview while the target is drawn. Region: 60 % of the tube, as a long limb.
#include <cmath>
#include <numbers>

#include "bench.h"
#include "pliant/sketch/sketch.h"
#include "support/shapes.h"

namespace pliant::bench {
namespace {

constexpr int kSamples = 500;
constexpr double kFrameMs = 1000.0 / 60.0;

/// The picture is 1000 pixels wide and 2 units of the scene high; the tube stands in its middle.
Camera camera() {
  CameraOptions options;
  options.eye = {0, -5, 0.5};
  options.target = {0, 0, 0.5};
  options.up = {0, 0, 1};
  options.orthographic_height = 2.0;
  options.width = options.height = 1000.0;
  return Camera::create(options).value();
}

/// From a fifth of the tube's height over 60 % of it, turning by `turn` radians on the way.
Stroke arc(double turn) {
  const double step = 300.0 / (kSamples - 1);
  Stroke stroke(2, kSamples);
  Eigen::Vector2d at(500, 650);
  for (int i = 0; i < kSamples; ++i) {
    stroke.col(i) = at;
    const double heading = 0.5 * std::numbers::pi - turn * (i + 0.5) / kSamples;
    at += step * Eigen::Vector2d(std::cos(heading), -std::sin(heading));
  }
  return stroke;
}

}  // namespace

static void bench_sketch(const Reporter& reporter) {
  const std::string name = "sketch 100,000 vertices";
  if (!reporter.wants(name)) return;
  const test::Mesh mesh = test::tube(250, 400, 0.05, 1.0);
  const std::shared_ptr<const Shape> shape = *Shape::create(mesh.positions, mesh.triangles);
  const Camera view = camera();
  const Stroke reference = arc(0.0), target = arc(2.0);
  std::unique_ptr<Sketch> sketch;
  Points shown;
  const double choose = median_ms(7, [&] {
    sketch = std::move(Sketch::create(shape, view, reference).value());
    if (!sketch->bend(target.leftCols(kSamples / 2), true).ok()) std::abort();
    shown = sketch->positions();
  });
  reporter.report(name + " region, skinning, first preview", choose, 100.0, "yardstick: 100 ms");
  int samples = 20;
  const double frame = median_ms(60, [&] {
    samples = 20 + (samples - 12) % (kSamples - 20);
    if (!sketch->bend(target.leftCols(samples), true).ok()) std::abort();
    shown = sketch->positions();
  });
  reporter.report(name + " preview frame", frame, kFrameMs, "yardstick: 1/60 s");
  reporter.report(name + " normals", median_ms(15, [&] { shown = sketch->normals(); }), kFrameMs);
}

namespace {
const Bench bench(bench_sketch);
}

}  // namespace pliant::bench
