#include "pliant/solve/deformation.h"

#include <utility>

namespace pliant {

Deformation::Deformation(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}

Result<Points> Deformation::transform_points(const Points&) const {
  return Status(ErrorCode::not_solvable,
                "this moves a surface, not the space around it; expected a method that carries points");
}

}  // namespace pliant
