#include "support/shapes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

namespace pliant::test {
namespace {

constexpr double pi = std::numbers::pi;

void add(Mesh& mesh, const Eigen::Vector3d& p) { mesh.positions.insert(mesh.positions.end(), {p.x(), p.y(), p.z()}); }

/// Two triangles for each cell of a grid of vertices; wrapped directions join the last to the
/// first.
void add_grid_triangles(Mesh& mesh, int columns, int rows, bool wrap_columns, bool wrap_rows, std::uint32_t first = 0) {
  const auto id = [&](int i, int j) { return first + static_cast<std::uint32_t>((j % rows) * columns + i % columns); };
  for (int j = 0; j + !wrap_rows < rows; ++j) {
    for (int i = 0; i + !wrap_columns < columns; ++i) {
      mesh.triangles.insert(mesh.triangles.end(), {id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.insert(mesh.triangles.end(), {id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
}

template <class Map>
Mesh mapped(const Mesh& mesh, Map map) {
  Mesh result;
  result.triangles = mesh.triangles;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    add(result, map(mesh.vertex(v)));
  }
  return result;
}

/// Unbiased enough and, unlike std::shuffle, the same with every standard library.
std::vector<Index> random_permutation(Index count, std::mt19937& random) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (Index i = count - 1; i > 0; --i) {
    std::swap(order[i], order[random() % static_cast<std::uint32_t>(i + 1)]);
  }
  return order;
}

}  // namespace

std::shared_ptr<const Shape> shape_of(const Mesh& mesh) {
  Result<std::shared_ptr<const Shape>> shape = Shape::create(mesh.positions, mesh.triangles);
  REQUIRE_MESSAGE(shape.ok(), shape.status().message());
  return *shape;
}

Mesh plane_grid(int columns, int rows, double width, double height) {
  Mesh mesh;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      add(mesh, {width * i / (columns - 1), height * j / (rows - 1), 0.0});
    }
  }
  add_grid_triangles(mesh, columns, rows, false, false);
  return mesh;
}

Mesh bumpy_plane(int n, int periods, double amplitude) {
  const double frequency = 2 * pi * periods;
  return mapped(plane_grid(n, n), [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), amplitude * std::sin(frequency * p.x()) * std::sin(frequency * p.y()));
  });
}

Mesh tube(int around, int along, double radius, double length) {
  Mesh mesh;
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      add(mesh, {radius * std::cos(angle), radius * std::sin(angle), length * j / (along - 1)});
    }
  }
  add_grid_triangles(mesh, around, along, true, false);
  return mesh;
}

Mesh sphere(int subdivisions) {
  const double g = std::numbers::phi;
  Mesh mesh{{-1, g,  0,  1, g, 0,  -1, -g, 0,  1, -g, 0, 0,  -1, g,  0,  1, g,
             0,  -1, -g, 0, 1, -g, g,  0,  -1, g, 0,  1, -g, 0,  -1, -g, 0, 1},
            {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
             3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1}};
  for (int round = 0; round < subdivisions; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] =
          middle_of.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices()));
      if (is_new) {
        add(mesh, mesh.vertex(static_cast<Index>(a)) + mesh.vertex(static_cast<Index>(b)));
      }
      return found->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const std::uint32_t a = mesh.triangles[i];
      const std::uint32_t b = mesh.triangles[i + 1];
      const std::uint32_t c = mesh.triangles[i + 2];
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.triangles = std::move(finer);
    mesh = mapped(mesh, [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p.normalized(); });
  }
  return mapped(mesh, [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p.normalized(); });
}

Mesh torus(int around, int across, double ring_radius, double tube_radius) {
  Mesh mesh;
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < around; ++i) {
      const double u = 2 * pi * i / around;
      const double v = 2 * pi * j / across;
      const double distance = ring_radius + tube_radius * std::cos(v);
      add(mesh, {distance * std::cos(u), distance * std::sin(u), tube_radius * std::sin(v)});
    }
  }
  add_grid_triangles(mesh, around, across, true, true);
  return mesh;
}

Mesh box(double width, double height, double depth, double cell) {
  const Eigen::Vector3d size(width, height, depth);
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const int columns = static_cast<int>(std::lround(size[u] / cell)) + 1;
    const int rows = static_cast<int>(std::lround(size[v] / cell)) + 1;
    for (const bool far : {true, false}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices());
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
          // On the near side u runs backwards, which turns the normal outwards.
          const int column = far ? i : columns - 1 - i;
          Eigen::Vector3d p;
          p[axis] = far ? size[axis] : 0.0;
          p[u] = size[u] * column / (columns - 1);
          p[v] = size[v] * j / (rows - 1);
          add(mesh, p);
        }
      }
      add_grid_triangles(mesh, columns, rows, false, false, first);
    }
  }
  return mesh;
}

Mesh soup(const Mesh& mesh) {
  Mesh result;
  for (const std::uint32_t corner : mesh.triangles) {
    result.triangles.push_back(static_cast<std::uint32_t>(result.vertices()));
    add(result, mesh.vertex(static_cast<Index>(corner)));
  }
  return result;
}

Mesh both(const Mesh& a, const Mesh& b) {
  Mesh result = a;
  result.positions.insert(result.positions.end(), b.positions.begin(), b.positions.end());
  for (const std::uint32_t corner : b.triangles) {
    result.triangles.push_back(corner + static_cast<std::uint32_t>(a.vertices()));
  }
  return result;
}

Mesh renumbered(const Mesh& mesh, std::uint32_t seed, std::vector<Index>* new_of_old) {
  std::mt19937 random(seed);
  const std::vector<Index> old_of_new = random_permutation(mesh.vertices(), random);
  std::vector<Index> new_ids(old_of_new.size());
  Mesh result;
  for (const Index old : old_of_new) {
    new_ids[old] = result.vertices();
    add(result, mesh.vertex(old));
  }
  for (const Index t : random_permutation(static_cast<Index>(mesh.triangles.size() / 3), random)) {
    const std::uint32_t turn = random() % 3;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t old = mesh.triangles[3 * t + (corner + turn) % 3];
      result.triangles.push_back(static_cast<std::uint32_t>(new_ids[old]));
    }
  }
  if (new_of_old != nullptr) {
    *new_of_old = std::move(new_ids);
  }
  return result;
}

Mesh transformed(const Mesh& mesh, double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  return mapped(mesh,
                [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return scale * (rotation * p) + translation; });
}

Mesh potato(int subdivisions) {
  return mapped(sphere(subdivisions), [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const double bump = std::exp(-8.0 * (p - Eigen::Vector3d(0.48, 0.6, 0.64)).squaredNorm());
    return (1.0 + 0.5 * bump + 0.1 * p.x() * p.y()) * p.cwiseProduct(Eigen::Vector3d(1.7, 1.0, 0.6));
  });
}

}  // namespace pliant::test
