// The `f` statements of an OBJ file, read by tinyobjloader. Internal to io.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace pliant::io {

/// A corner as the file spells it: from one up, or below zero counted back; 0 where there is none
/// or the number cannot be read.
struct ObjCorner {
  int vertex;
  int texcoord;
};

/// Receives the statements in order.
class ObjFaceVisitor {
 public:
  virtual ~ObjFaceVisitor() = default;
  virtual void face(std::span<const ObjCorner> corners) = 0;
};

/// `statements`: lines "f ...", each with at least one corner; many in one call are cheaper.
void read_obj_faces(std::string_view statements, ObjFaceVisitor& visitor);

}  // namespace pliant::io
