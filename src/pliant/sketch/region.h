// The region of interest of a stroke: what is held, what is deformed, what follows rigidly. Kho and
// Garland, section 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/sketch/laid_stroke.h"

namespace pliant {

inline constexpr Index kStaticLabel = 0;
inline constexpr Index kRegionLabel = 1;
inline constexpr Index kFirstRigidLabel = 2;

/// Which end of a reference stroke is held: the start, the end, or that beyond which more of the
/// shape lies, by area (the start where the end has less than a tenth more).
enum class Hold : std::uint8_t { larger, start, end };

/// The triangles of the component that the stroke lies on, ascending: the one that most pixels of it
/// meet first, or else that of the point nearest to it in the picture.
std::vector<Index> component_under(const SeenShape& shape, const LaidStroke& stroke);

/// Whether more of that component lies beyond the stroke's end, as `Hold::larger` has it.
bool more_beyond_end(const SeenShape& shape, const LaidStroke& stroke, std::span<const Index> component);

/// A label a triangle, and a label a point: static where any of its triangles is, else rigid where
/// any is. No edge joins points of two parts of which none is the region: it would be torn.
struct Region {
  std::vector<Index> of_triangle;
  std::vector<Index> of_point;
  Index rigid_parts = 0;
  double start = 0.0;  ///< s at which the stroke's region begins
};

/// Cuts across both ends of the stroke (`EndCutter`), each through the whole component that it lies
/// on, then along the partitions. What lies beyond the start is static, what lies beyond the end rigid, all else
/// region: also what lies between the planes on other tubes of a ring, and what lies beyond both
/// where the planes cross. Static and rigid part are kept apart by a fraction of the stroke's length.
/// An end that no plane cuts off (the stroke runs beyond the shape) leaves no static or no rigid
/// part.
/// Errors: invalid_option (nothing is covered, or so little that no bend would show, since the
/// stroke leaves the shape at once; a partition that cuts nothing off).
Result<Region> choose_region(const SeenShape& shape, const LaidStroke& stroke, std::span<const Index> component,
                             std::span<const Polyline> partitions);

/// Two points of an edge that would be torn, that of the larger label first.
std::optional<std::array<Index, 2>> torn_edge(const Triangles& triangles, std::span<const Index> of_point);

/// Whether the stroke runs from what moves to what is static, in a region that is given.
bool runs_to_static(const SeenShape& shape, const PlaneCurve& curve, const Region& region);

/// A region from given labels of the points, rigid parts numbered without gaps.
Region region_from_labels(const Triangles& triangles, std::span<const Index> of_point);

}  // namespace pliant
