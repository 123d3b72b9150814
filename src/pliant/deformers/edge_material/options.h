// Options of material-aware edges.
#pragma once

#include <optional>
#include <vector>

#include "pliant/core/named_values.h"
#include "pliant/geometry/shape.h"

namespace pliant {

/// A direction on the surface, sign without meaning, along which edges resist most (eq. 13): where
/// an edge lies across it, its stretch and bend stiffness drop to a hundredth. Where the field
/// vanishes the material is isotropic.
struct DirectionField {
  enum class Kind {
    none,           ///< isotropic
    strokes,        ///< painted: `strokes`, interpolated over the surface
    axis,           ///< `axis`, projected on the surface
    curvature_max,  ///< along the largest principal curvature (its absolute value)
    curvature_min,  ///< along the smallest
    geodesic,       ///< along the shortest paths from `sources`
  };
  Kind kind = Kind::none;
  std::vector<Points> strokes = {};  ///< polylines near the surface, at least two points each
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  std::vector<Index> sources = {};  ///< input vertices

  bool operator==(const DirectionField& other) const;
};

struct EdgeMaterialOptions {
  /// Stiffness against stretch, free of resolution: lambda = stretch (h / L)^2 with h the mean edge
  /// length and L the diagonal of the shape. At least 0.
  double stretch = 1.0;
  /// The paper's own lambda of eq. 7, in the place of `stretch`.
  std::optional<double> lambda = {};
  /// Stiffness against bending: mu of eq. 7. At least 0; not both 0.
  double bend = 1.0;
  /// Parts of the two stiffnesses that act, 0 to 1 (eq. 15); free of cost while dragging.
  double p_stretch = 1.0;
  double p_bend = 1.0;
  /// Pull on every vertex is gravity lambda L / n, along `gravity`. Parts of the shape that nothing
  /// holds do not fall.
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  DirectionField field = {};

  /// Errors: invalid_option, naming the option, its value and what was expected.
  Status validate(const Shape& shape) const;
};

/// `stretch` and `lambda` stand for one another: giving one takes the other back.
void exchange(NamedFields& fields, EdgeMaterialOptions& options);

}  // namespace pliant
