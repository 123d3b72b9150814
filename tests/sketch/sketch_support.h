// Shapes, cameras and strokes for the tests of sketching.
#pragma once

#include <functional>
#include <memory>

#include "pliant/sketch/sketch.h"
#include "support/shapes.h"

namespace pliant::test {

/// A closed cylinder about the z axis from 0 to 1: `along` rings of `around` vertices, ring by
/// ring, then the centres of its two lids.
Mesh cylinder(int around, int along, double radius);

/// The surface of the unit cells (x, y, z) that `solid` holds, each side two triangles with
/// vertices of their own.
Mesh cells(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid);

/// Looks along y at x (right) and z (up); 500 pixels a unit, (500, 500) is x = 0, z = 0.5.
CameraOptions front_view();
/// The pixel of front_view that shows (x, z).
Eigen::Vector2d front_pixel(double x, double z);

/// A straight stroke of `samples`.
Stroke straight(const Eigen::Vector2d& a, const Eigen::Vector2d& b, int samples = 100);
/// A stroke of length 500 `length` px from `start`, upwards at first, with `curvature` (1 / unit,
/// to the left) over its normalised length.
Stroke curved(const Eigen::Vector2d& start, double length, const std::function<double(double)>& curvature,
              int samples = 1000);

std::unique_ptr<Sketch> sketch_on(const Mesh& mesh, const Stroke& reference, const SketchOptions& options = {},
                                  const CameraOptions& camera = front_view());

/// Points of the shape, deformed.
Points point_positions(const Sketch& sketch);

double diagonal(const Mesh& mesh);
Points positions_of(const Mesh& mesh);

}  // namespace pliant::test
