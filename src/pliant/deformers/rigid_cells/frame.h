// Where the grid of cells lies: its axes, its unit and its extent.
#pragma once

#include "pliant/geometry/shape.h"

namespace pliant::cells {

/// A grid of cubes (squares in the plane) about a shape. Grid coordinates are along the grid's axes
/// in units of the smallest cell there can be; the lowest corner of the grid is the origin. In the
/// plane z is 0 in both.
struct GridFrame {
  int dimension = 3;
  int depth = 0;  ///< levels below the coarse cells: a coarse one is 2^depth units wide
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows
  Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< of the grid, scene coordinates
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();    ///< the same, grid coordinates
  Eigen::Vector3i counts = Eigen::Vector3i::Ones();    ///< coarse cells along the axes
  double unit = 1.0;                                   ///< length of a grid unit in the scene

  Eigen::Vector3d to_grid(const Eigen::Vector3d& p) const { return axes * (p - center) / unit + middle; }
  Eigen::Vector3d to_scene(const Eigen::Vector3d& g) const { return axes.transpose() * ((g - middle) * unit) + center; }
};

/// The frame with `resolution` coarse cells along the shape's longest side. align: along its
/// principal axes, so that turning the scene changes nothing; else along the world's.
GridFrame grid_frame(const Shape& shape, int resolution, int depth, bool align);

}  // namespace pliant::cells
