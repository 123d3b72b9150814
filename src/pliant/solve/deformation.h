// What every result has, whether a solver found it or a stroke: positions, normals, and its life.
#pragma once

#include <memory>

#include "pliant/core/status.h"
#include "pliant/geometry/shape.h"
#include "pliant/solve/state.h"

namespace pliant {

/// A shape and where it is now. All vertex ids are those of the input, lengths are in its unit;
/// point sets are 3 x n (z = 0 in the plane).
class Deformation {
 public:
  explicit Deformation(std::shared_ptr<const Shape> shape);
  virtual ~Deformation() = default;
  Deformation(const Deformation&) = delete;
  Deformation& operator=(const Deformation&) = delete;

  const Shape& shape() const { return *shape_; }

  /// 3 x n deformed positions of the input's vertices, then of those that were added.
  virtual Points positions() const = 0;
  /// 3 x n unit normals of the deformed shape.
  virtual Points normals() const = 0;
  /// Any other points carried by the same deformation, 3 x q, in rest coordinates.
  /// Errors: not_solvable where a surface is moved and not the space around it, as here.
  virtual Result<Points> transform_points(const Points& points) const;
  /// Normals of a surface at these points, 3 x q each, turned as the deformation turns the surface: by the cofactors of
  /// its differential, which differences of transform_points stand for. A normal keeps its length; where the surface is
  /// crushed, or there is no normal, it stays as it is. Errors: as transform_points.
  Result<Points> transform_normals(const Points& points, const Points& normals) const;

  /// Back to rest, bit for bit; what was chosen to be held or moved stays so.
  virtual void reset() = 0;
  /// Everything needed to recompute the result without Pliant (docs/state-and-report.md).
  virtual State save() const = 0;
  /// Takes what was saved of the same kind on the same shape.
  /// Errors: invalid_option (a field is missing or does not fit); nothing has changed then.
  virtual Status restore(const State& state) = 0;

 private:
  std::shared_ptr<const Shape> shape_;
};

}  // namespace pliant
