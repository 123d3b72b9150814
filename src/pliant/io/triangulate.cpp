#include "pliant/io/triangulate.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace pliant::io {
namespace {

using Vector = std::array<double, 3>;

/// A corner in the plane of the polygon.
struct Planar {
  double x, y;
  bool operator==(const Planar&) const = default;
};

/// Twice the signed area of a triangle: positive when it turns left.
double area(const Planar& a, const Planar& b, const Planar& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class Triangulator {
 public:
  explicit Triangulator(const PolygonMesh& mesh) : mesh_(mesh) {}

  std::vector<std::uint32_t> run() {
    triangles_.reserve(3 * (mesh_.face_vertices.size() - 2 * mesh_.face_count()));
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      first_ = mesh_.face_offsets[f];
      add_polygon(mesh_.face_offsets[f + 1] - first_);
    }
    return std::move(triangles_);
  }

 private:
  void add_polygon(std::size_t corners);
  void add(std::size_t a, std::size_t b, std::size_t c);
  void project(std::size_t corners);
  bool is_strictly_convex() const;
  void clip_ears();
  bool is_ear(std::size_t at);
  std::size_t before(std::size_t at) const { return (at + left_.size() - 1) % left_.size(); }
  std::size_t after(std::size_t at) const { return (at + 1) % left_.size(); }
  double area_at(std::size_t at) const {
    return area(plane_[left_[before(at)]], plane_[left_[at]], plane_[left_[after(at)]]);
  }
  const double* position(std::size_t corner) const {
    return &mesh_.positions[3 * std::size_t{mesh_.face_vertices[first_ + corner]}];
  }

  const PolygonMesh& mesh_;
  std::vector<std::uint32_t> triangles_;
  std::size_t first_ = 0;              ///< corner of the mesh the polygon starts at
  std::vector<Planar> plane_;          ///< its corners
  std::vector<std::size_t> left_;      ///< those not clipped yet
  std::int64_t budget_ = 100'000'000;  ///< tests of a corner against an ear
};

void Triangulator::add(std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t corner : {a, b, c}) {
    triangles_.push_back(mesh_.face_vertices[first_ + corner]);
  }
}

void Triangulator::add_polygon(std::size_t corners) {
  left_.resize(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    left_[i] = i;
  }
  if (corners > 3) {
    project(corners);
    if (!is_strictly_convex()) {
      clip_ears();
    }
  }
  for (std::size_t i = 1; i + 1 < left_.size(); ++i) {
    add(left_[0], left_[i], left_[i + 1]);
  }
}

/// Along the axis nearest to the area vector (Newell), so that the polygon turns left.
void Triangulator::project(std::size_t corners) {
  Vector normal{};
  const double* origin = position(0);
  for (std::size_t i = 1; i + 1 < corners; ++i) {
    const double* a = position(i);
    const double* b = position(i + 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3;
      const std::size_t v = (k + 2) % 3;
      normal[k] += (a[u] - origin[u]) * (b[v] - origin[v]) - (a[v] - origin[v]) * (b[u] - origin[u]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) {
      axis = k;
    }
  }
  std::size_t u = (axis + 1) % 3;
  std::size_t v = (axis + 2) % 3;
  if (normal[axis] < 0) {
    std::swap(u, v);
  }
  plane_.clear();
  for (std::size_t i = 0; i < corners; ++i) {
    const double* p = position(i);
    plane_.push_back({p[u] - origin[u], p[v] - origin[v]});
  }
}

bool Triangulator::is_strictly_convex() const {
  for (std::size_t i = 0; i < left_.size(); ++i) {
    if (!(area_at(i) > 0)) {
      return false;
    }
  }
  return true;
}

/// Clips until a triangle is left. Where no corner is an ear, the one with the largest turn goes.
void Triangulator::clip_ears() {
  std::size_t at = 0;
  std::size_t tried = 0;
  std::size_t best = 0;
  while (left_.size() > 3 && budget_ > 0) {
    const bool ear = is_ear(at);
    if (!ear) {
      if (tried == 0 || area_at(at) > area_at(best)) {
        best = at;
      }
      if (++tried < left_.size()) {
        at = after(at);
        continue;
      }
      at = best;
    }
    add(left_[before(at)], left_[at], left_[after(at)]);
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
    budget_ -= static_cast<std::int64_t>(left_.size()) / 16;
    // Starting behind the corner that lost its neighbour spreads the ears around the polygon.
    at = at % left_.size();
    tried = 0;
  }
}

/// Whether the triangle at a corner turns left and holds no other corner. Corners at the position
/// of one of its own do not count: a hole joined to the outline repeats some.
bool Triangulator::is_ear(std::size_t at) {
  const std::size_t previous = before(at);
  const std::size_t next = after(at);
  const Planar& a = plane_[left_[previous]];
  const Planar& b = plane_[left_[at]];
  const Planar& c = plane_[left_[next]];
  --budget_;
  if (!(area(a, b, c) > 0)) {
    return false;
  }
  budget_ -= static_cast<std::int64_t>(left_.size());
  for (std::size_t i = 0; i < left_.size(); ++i) {
    if (i == previous || i == at || i == next) {
      continue;
    }
    const Planar& p = plane_[left_[i]];
    if (p == a || p == b || p == c) {
      continue;
    }
    if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> triangulate(const PolygonMesh& mesh) { return Triangulator(mesh).run(); }

}  // namespace pliant::io
