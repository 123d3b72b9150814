// What adaptive refinement added to a mesh, in ids of the input's vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Added vertices follow the input's n: vertex n + i lies in the middle between the two vertices
/// parents[i], which may be added ones before it. Copies at a seam are split apart, so that texture
/// coordinates, normals or weights are carried by `carry`; dropping it all undoes the refinement.
struct Refinement {
  std::vector<std::array<Index, 2>> parents;
  std::vector<std::uint32_t> triangles;         ///< 3 x m' vertex ids, in place of the input's
  std::vector<std::uint32_t> triangle_parents;  ///< of each triangle, the input's it is a part of

  /// Appends to values of the input's vertices (`width` numbers each) those of the added ones.
  template <class Number>
  void carry(std::vector<Number>& values, std::size_t width) const {
    values.reserve(values.size() + width * parents.size());
    for (const auto& [a, b] : parents) {
      for (std::size_t k = 0; k < width; ++k) {
        values.push_back((values[a * width + k] + values[b * width + k]) / 2);
      }
    }
  }
};

}  // namespace pliant
