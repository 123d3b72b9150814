#include "io/io_support.h"

namespace pliant::io::test {
namespace {

constexpr const char* obj =
    "\xEF\xBB\xBF# a quad, a triangle and a line\r\n"
    "mtllib some file.mtl\r\n"
    "o Thing\r\n"
    "v 0 0 0 1 0.5 0.25\r\n"
    "  v\t1.25e0  0 -0 # a comment\r\n"
    "v 1 +1 .5\r\n"
    "v 0 1. 0 1.0\r\n"
    "vt 0 0\nvt 1 0 0\nvt 1 1\nvt 0.1\n"
    "vn 0 0 1\n"
    "g front  \\\n"
    "usemtl red\ns 1\n"
    "f 1/1/1 2/2/1 3/3/1 4/4/1 # the quad\n"
    "v 2 \\\n  3 \\\r\n 4\n"
    "vn 0 1 0\r\n"
    "f -1//2 1//1 -4//1# 5//5\n"
    "\n"
    "l 1 2 3\n"
    "f 1 2 \\\n 3 5";

constexpr const char* ply_text =
    "ply\nformat ascii 1.0\ncomment made by hand\nobj_info nothing\n"
    "element vertex 4\n"
    "property uchar red\nproperty float nx\nproperty float x\nproperty float y\n"
    "property float ny\nproperty double z\nproperty float nz\nproperty list uchar int tags\n"
    "property float u\nproperty float v\n"
    "element face 3\nproperty list uchar uint vertex_indices\nproperty uchar flag\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    "end_header\n"
    "255 0 0 0 0 0.5 1 0 0.25 0.5\n"
    "0 0 1.5 0 0 0 1 2 7 8 0.75 0.5\n"
    "\n"
    "1 0  1  1  0  0  1  0  1 1\n"
    "2 0 0 1 0 0 1 1 9 0 1  \n"
    "4 0 1 2 3 1\n"
    "3 0 2 3 0\n"
    "2 0 1 0\n"
    "0 1\n"
    "trailing words\n";

std::string ply_header(const char* format) {
  return std::string("ply\r\nformat ") + format +
         " 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty short y\r\n"
         "property uchar red\r\nproperty float nx\r\nproperty double z\r\n"
         "element face 2\r\nproperty int material\r\n"
         "property list uchar int vertex_index\r\nproperty list ushort float texcoord\r\n"
         "end_header\r\n";
}

std::string ply_binary(bool big) {
  std::string file = ply_header(big ? "binary_big_endian" : "binary_little_endian");
  const float xs[] = {0.0f, 1.1f, 1.0f, -0.0f};
  const std::int16_t ys[] = {0, 0, 300, -7};
  for (int i = 0; i < 4; ++i) {
    file += binary<float>({xs[i]}, big) + binary<std::int16_t>({ys[i]}, big) + "\x0A" + binary<float>({1.0f}, big) +
            binary<double>({0.1 * i}, big);
  }
  file += binary<std::int32_t>({5}, big) + "\x04" + binary<std::int32_t>({0, 1, 2, 3}, big) +
          binary<std::uint16_t>({8}, big) + binary<float>({0, 0, 1, 0, 1, 1, 0, 0.5f}, big);
  file += binary<std::int32_t>({6}, big) + "\x03" + binary<std::int32_t>({3, 2, 0}, big) +
          binary<std::uint16_t>({6}, big) + binary<float>({0, 0, 1, 0, 1, 1}, big);
  return file + "the end";
}

constexpr const char* off =
    "# first a comment\nSTCNOFF # with everything\n\n4 2 0\n"
    "0 0 0  0 0 1  255 0 0 255  0 0\n"
    "  1 0 0.1  0 0 1  255 0 0 255  1 0 # second\n"
    "# between\n"
    "1 1 0  0 0 1  255 0 0 255  1 1\n"
    "0 1 0  0 0 1  255 0 0 255  0 1\r\n"
    "4 0 1 2 3  255 255 255\n"
    "3 0 2 3\n"
    "# at the end";

constexpr const char* stl_text =
    "solid two facets\n"
    "  facet normal nan nan nan\n    outer loop\n"
    "      vertex 0 0 0\n      vertex 1e0 0 0\n      vertex 0 1 0\n    endloop\n  endfacet\n"
    "\n"
    "FACET NORMAL 9 9 9\nOUTER LOOP\nVERTEX 0 0 0\n VERTEX 0 0 0.1\nVERTEX 0 0 0\nENDLOOP\n"
    "ENDFACET\r\n"
    "endsolid two facets\nsolid again\nendsolid again\n";

std::string stl_binary() {
  std::string file = "solid but binary";
  file.resize(80);
  file += binary<std::uint32_t>({2});
  for (const float x : {1.0f, 2.5f}) {
    file += binary<float>({0, 0, 0, 0, 0, 0, x, 0, 0, 0, 1.1f, 0}) + "ab";
  }
  return file + "tail";
}

constexpr const char* xyz =
    "# points\n// of a scan\n\n0 0 0\n 1.5\t2 3  0 0 1  255 0 0\r\n-1e-3 +2 .5 words too\n4 5 6";

}  // namespace

std::vector<Sample> samples() {
  return {{"obj", FileFormat::obj, obj},
          {"ply ascii", FileFormat::ply, ply_text},
          {"ply little endian", FileFormat::ply, ply_binary(false)},
          {"ply big endian", FileFormat::ply, ply_binary(true)},
          {"off", FileFormat::off, off},
          {"stl text", FileFormat::stl, stl_text},
          {"stl binary", FileFormat::stl, stl_binary()},
          {"xyz", FileFormat::xyz, xyz}};
}

}  // namespace pliant::io::test
