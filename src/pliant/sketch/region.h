// The region of interest of a stroke: what is held, what is deformed, what follows rigidly. Kho and
// Garland, section 4.2.
#pragma once

#include <span>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/curves/plane_curve.h"
#include "pliant/sketch/camera.h"
#include "pliant/sketch/hits.h"

namespace pliant {

inline constexpr Index kStaticLabel = 0;
inline constexpr Index kRegionLabel = 1;
inline constexpr Index kFirstRigidLabel = 2;

/// A shape seen through a camera.
struct SeenShape {
  Camera camera;
  Points view;  ///< its points in view coordinates, 3 x p
  const Triangles& triangles;
};

/// A reference stroke laid into space.
struct LaidStroke {
  Polyline pixels;                     ///< filtered, of equal steps
  std::vector<std::vector<Hit>> hits;  ///< of every pixel
  double depth = 0.0;                  ///< of the plane parallel to the image
  PlaneCurve curve;                    ///< on that plane, x and y of view coordinates
};

/// Section 4.1. The plane goes through the first hit of the first pixel; where that misses the
/// shape, through that of the next pixel along the stroke that meets it; where none does, through
/// the centroid. Errors: invalid_option (the plane is behind the eye).
Result<LaidStroke> lay_stroke(const SeenShape& shape, const Polyline& pixels);

/// A label a triangle, and a label a point: static where any of its triangles is, else rigid where
/// any is.
struct Region {
  std::vector<Index> of_triangle;
  std::vector<Index> of_point;
  Index rigid_parts = 0;
  double start = 0.0;  ///< s at which the stroke's region begins
};

/// Cuts across both ends of the stroke, then along the partitions. An end that no plane cuts off
/// (the stroke runs beyond the shape) leaves no static or no rigid part. A plane that would run
/// through more than the limb (its loop comes near to quite other places of the stroke) moves along
/// the stroke, at most over 40 % of it, until it crosses the limb alone.
/// Errors: invalid_option (nothing is covered, a partition that cuts nothing off).
Result<Region> choose_region(const SeenShape& shape, const LaidStroke& stroke, std::span<const Polyline> partitions);

/// A region from given labels of the points, rigid parts numbered without gaps.
Region region_from_labels(const Triangles& triangles, std::span<const Index> of_point);

}  // namespace pliant
