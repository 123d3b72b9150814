// Small shapes with known properties, for all tests.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pliant/geometry/shape.h"

namespace pliant::test {

/// What a caller would pass to Shape::create.
struct Mesh {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;

  Index vertices() const { return static_cast<Index>(positions.size() / 3); }
  Eigen::Vector3d vertex(Index v) const { return Eigen::Vector3d(&positions[3 * v]); }
};

/// Checks the mesh through the door; the test fails when it is not accepted.
std::shared_ptr<const Shape> shape_of(const Mesh& mesh);

/// `columns` x `rows` vertices over [0, width] x [0, height] in the plane z = 0, normals up, vertex
/// (i, j) is number j * columns + i.
Mesh plane_grid(int columns, int rows, double width = 1.0, double height = 1.0);

/// The unit square with n x n vertices and z = amplitude sin(2 pi periods x) sin(2 pi periods y).
Mesh bumpy_plane(int n, int periods, double amplitude);

/// A tube about the z axis from z = 0 to `length`, open at both ends; vertex (i, j) is number
/// j * around + i.
Mesh tube(int around, int along, double radius = 1.0, double length = 1.0);

/// A unit icosahedron whose triangles are split in four `subdivisions` times, on the unit sphere.
Mesh sphere(int subdivisions);

/// A torus about the z axis.
Mesh torus(int around, int across, double ring_radius = 1.0, double tube_radius = 0.3);

/// The closed box [0, width] x [0, height] x [0, depth], each side a grid of cells of side `cell`
/// (the sizes should be multiples of it); its edges are copied along the seams between sides.
Mesh box(double width, double height, double depth, double cell);

/// The same triangles with three vertices of their own each.
Mesh soup(const Mesh& mesh);

/// Both meshes in one; nothing is joined.
Mesh both(const Mesh& a, const Mesh& b);

/// The same mesh with vertices and triangles in another order, and the corners of each triangle
/// rotated.
Mesh renumbered(const Mesh& mesh, std::uint32_t seed, std::vector<Index>* new_of_old = nullptr);

/// x -> scale * rotation * x + translation.
Mesh transformed(const Mesh& mesh, double scale, const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity(),
                 const Eigen::Vector3d& translation = Eigen::Vector3d::Zero());

/// A closed shape without any symmetry: a sphere with unequal axes and a bump.
Mesh potato(int subdivisions);

}  // namespace pliant::test
