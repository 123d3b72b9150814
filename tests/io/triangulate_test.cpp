#include "pliant/io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

namespace pliant::io {
namespace {

using Triangles = std::vector<std::uint32_t>;

/// One polygon over points of the plane z = 0, moved somewhere in space.
PolygonMesh polygon(const std::vector<Eigen::Vector2d>& corners) {
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, 2, 3).normalized());
  PolygonMesh mesh;
  for (const Eigen::Vector2d& corner : corners) {
    const Eigen::Vector3d p = turn * Eigen::Vector3d(corner.x(), corner.y(), 0.0);
    mesh.positions.insert(mesh.positions.end(), {p.x() + 5.0, p.y(), p.z()});
    mesh.face_vertices.push_back(static_cast<std::uint32_t>(mesh.face_vertices.size()));
  }
  mesh.face_offsets.push_back(static_cast<std::uint32_t>(corners.size()));
  return mesh;
}

double signed_area(const std::vector<Eigen::Vector2d>& p, const std::vector<std::uint32_t>& ids) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Eigen::Vector2d& a = p[ids[i]];
    const Eigen::Vector2d& b = p[ids[(i + 1) % ids.size()]];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// k - 2 triangles, none turned over, whose areas add up to the polygon's: they cover it once.
void check_covers(const std::vector<Eigen::Vector2d>& corners) {
  const Triangles triangles = triangulate(polygon(corners));
  REQUIRE(triangles.size() == 3 * (corners.size() - 2));
  std::vector<std::uint32_t> outline(corners.size());
  std::iota(outline.begin(), outline.end(), 0u);
  const double whole = signed_area(corners, outline);
  double sum = 0.0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const double part = signed_area(corners, {triangles[t], triangles[t + 1], triangles[t + 2]});
    CHECK(part >= -1e-9 * whole);
    sum += part;
  }
  CHECK(sum == doctest::Approx(whole).epsilon(1e-9));
}

TEST_CASE("a convex polygon becomes a fan from its first corner") {
  CHECK(triangulate(polygon({{0, 0}, {1, 0}, {0, 1}})) == Triangles{0, 1, 2});
  CHECK(triangulate(polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}})) == Triangles{0, 1, 2, 0, 2, 3});
  CHECK(triangulate(polygon({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}})) == Triangles{0, 1, 2, 0, 2, 3, 0, 3, 4});
}

TEST_CASE("a concave quad is cut at its reflex corner") {
  for (int shift = 0; shift < 4; ++shift) {
    std::vector<Eigen::Vector2d> corners{{0, 0}, {2, 1}, {4, 0}, {2, 4}};
    std::rotate(corners.begin(), corners.begin() + shift, corners.end());
    check_covers(corners);
  }
}

TEST_CASE("concave polygons are covered once") {
  std::vector<Eigen::Vector2d> star;
  std::vector<Eigen::Vector2d> comb;
  std::vector<Eigen::Vector2d> spiral;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 40;
    star.push_back((i % 2 ? 0.3 : 1.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (int i = 0; i < 30; ++i) comb.push_back({i, i % 2 ? 5.0 : 0.0});
  comb.insert(comb.end(), {{29, 6}, {0, 6}});
  for (int i = 0; i <= 60; ++i) spiral.push_back({(1 + i) * std::cos(0.3 * i), (1 + i) * std::sin(0.3 * i)});
  for (int i = 60; i >= 0; --i) spiral.push_back({(4 + i) * std::cos(0.3 * i), (4 + i) * std::sin(0.3 * i)});
  check_covers(star);
  check_covers(comb);
  std::reverse(spiral.begin(), spiral.end());
  check_covers(spiral);
}

TEST_CASE("corners on a straight line and a hole joined to the outline") {
  check_covers({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  check_covers({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST_CASE("polygons without a plane, area or simple outline still give k - 2 triangles") {
  CHECK(triangulate(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).size() == 6);
  CHECK(triangulate(polygon({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}})).size() == 9);
  CHECK(triangulate(polygon({{1, 1}, {1, 1}, {1, 1}, {1, 1}})).size() == 6);
  CHECK(triangulate(polygon({{0, 0}, {1e200, 0}, {-1e200, 1e200}, {3, -1e300}})).size() == 6);
}

TEST_CASE("a polygon too large for its work ends as a fan") {
  std::vector<Eigen::Vector2d> comb;
  for (int i = 0; i < 60'000; ++i) comb.push_back({i, i % 2 ? 5.0 - 1e-5 * i : 0.0});
  comb.push_back({30'000, 1e6});
  CHECK(triangulate(polygon(comb)).size() == 3 * (comb.size() - 2));
}

}  // namespace
}  // namespace pliant::io
