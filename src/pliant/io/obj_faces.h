// The `f` statements of an OBJ file, read by tinyobjloader. Internal to io.
#pragma once

#include <cstddef>
#include <span>
#include <string>

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

/// `statements`: lines "f ...", each with at least one corner. tinyobjloader sets up a stream a
/// call, so many lines in one call are cheaper than one.
void read_obj_faces(std::string& statements, ObjFaceVisitor& visitor);

}  // namespace pliant::io
