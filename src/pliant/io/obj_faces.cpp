#include "pliant/io/obj_faces.h"

#include "pliant/io/tinyobj_streams.h"

// tinyobj_streams.h says why.
#define std pliant::io::tinyobj_std
#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>
#undef std

namespace pliant::io {
namespace {

struct Relay {
  ObjFaceVisitor& visitor;
  std::vector<ObjCorner> corners;
};

void relay_face(void* user_data, tinyobj::index_t* indices, int count) {
  auto& relay = *static_cast<Relay*>(user_data);
  relay.corners.clear();
  for (int i = 0; i < count; ++i) {
    relay.corners.push_back({indices[i].vertex_index, indices[i].texcoord_index});
  }
  relay.visitor.face(relay.corners);
}

}  // namespace

void read_obj_faces(std::string_view statements, ObjFaceVisitor& visitor) {
  tinyobj_std::streambuf buffer(statements.data(), statements.data() + statements.size());
  tinyobj_std::istream stream(&buffer);
  Relay relay{visitor, {}};
  tinyobj::callback_t callbacks;
  callbacks.index_cb = relay_face;
  tinyobj::LoadObjWithCallback(stream, callbacks, &relay);
}

}  // namespace pliant::io
