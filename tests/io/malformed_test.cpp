#include <cmath>

#include "io/io_support.h"

namespace pliant::io {
namespace {

struct Malformed {
  FileFormat format;
  std::string file;
  std::string complaint;
};

std::string ply(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

const std::string xyz_properties = "property float x\nproperty float y\nproperty float z\n";
const std::string face_element = "element face 1\nproperty list uchar int vertex_indices\n";

std::string binary_ply(const std::string& elements, const std::string& body) {
  return "ply\nformat binary_little_endian 1.0\n" + elements + "end_header\n" + body;
}

std::string binary_stl(std::uint32_t facets, std::size_t size) {
  std::string file(80, '\0');
  file += test::binary<std::uint32_t>({facets});
  file.resize(84 + size);
  return file;
}

std::string facet(const std::string& lines) {
  return "solid s\nfacet normal 0 0 1\nouter loop\n" + lines + "endloop\nendfacet\nendsolid s\n";
}

std::vector<Malformed> obj_files() {
  const std::string v3 = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto obj = FileFormat::obj;
  return {
      {obj, "", "the file has no vertices"},
      {obj, "# nothing\nf 1 2 3\n", "the file has no vertices"},
      {obj, std::string("\x00\x01\x02\xFF", 4), "the file has no vertices"},
      {obj, "v 0 0\n", "line 1: expected 3 coordinates, found 2"},
      {obj, "v", "line 1: expected 3 coordinates, found 0"},
      {obj, "v 0 0 0\n\nv 0 abc 0\n", "line 3: y is \"abc\"; expected a finite decimal number"},
      {obj, "v 0 0 nan\n", "line 1: z is \"nan\"; expected a finite decimal number"},
      {obj, "v inf 0 0\n", "line 1: x is \"inf\"; expected a finite decimal number"},
      {obj, "v 1e999 0 0\n", "line 1: x is \"1e999\"; expected a finite decimal number"},
      {obj, "v 1,5 0 0\n", "line 1: x is \"1,5\"; expected a finite decimal number"},
      {obj, std::string("v 1 2 3\0\n", 9), "line 1: z is \"3?\"; expected a finite decimal number"},
      {obj, v3 + "vt x\n", "line 4: texture coordinate is \"x\"; expected a finite decimal number"},
      {obj, v3 + "vt\n", "line 4: texture coordinate is \"\"; expected a finite decimal number"},
      {obj, v3 + "f 1 2 99\n", "line 4: face refers to vertex 99; the file has 3 vertices"},
      {obj, "f 1 2 5\n" + v3, "line 1: face refers to vertex 5; the file has 3 vertices"},
      {obj, v3 + "f 1 2 -4\n", "line 4: face refers to vertex -4; 3 stand before it"},
      {obj, "f 1 2 -1\n" + v3, "line 1: face refers to vertex -1; 0 stand before it"},
      {obj, v3 + "f 0 1 2\n", "line 4: face refers to vertex 0; ids count from 1"},
      {obj, v3 + "\nf 1 2\n", "line 5: face has 2 corners; expected at least 3"},
      {obj, v3 + "f\n", "line 4: face has 0 corners; expected at least 3"},
      {obj, v3 + "f 1 2 x\n", "line 4: face corner is \"x\"; expected vertex ids, as in 1/2/3"},
      {obj, v3 + "f 1 2 3.5\n", "line 4: face corner is \"3.5\"; expected vertex ids, as in 1/2/3"},
      {obj, v3 + "f 1 2 1-2\n", "line 4: face corner is \"1-2\"; expected vertex ids, as in 1/2/3"},
      {obj, v3 + "f 1/ 2 3\n", "line 4: face corner is \"1/\"; expected vertex ids, as in 1/2/3"},
      {obj, v3 + "f 1 2 4294967297\n", "line 4: face corner is \"4294967297\"; expected vertex ids, as in 1/2/3"},
      {obj, v3 + "vt 0 0\nf 1/1 2/1 3/2\n",
       "line 5: face refers to texture coordinate 2; the file has 1 texture coordinates"},
      {obj, v3 + "f 1/-1 2 3\nvt 0 0\n", "line 4: face refers to texture coordinate -1; 0 stand before it"},
      {obj, "v 0 0 \\\n", "line 1: expected 3 coordinates, found 2"},
  };
}

std::vector<Malformed> ply_files() {
  const auto format = FileFormat::ply;
  const std::string vertex = "element vertex 1\n" + xyz_properties;
  const std::string lists = "element vertex 1\n" + xyz_properties + face_element;
  return {
      {format, "", "line 1: expected ply, found the end of the file"},
      {format, "OFF\n", "line 1: expected ply, found \"OFF\""},
      {format, "ply\nformat ascii 1.0\n", "line 1: the header has no end_header line"},
      {format, "ply\nend_header\n", "line 2: the header has no format line"},
      {format, "ply\nformat binary 1.0\nend_header\n",
       "line 2: format is \"binary\"; expected ascii, binary_little_endian or "
       "binary_big_endian"},
      {format, ply("", ""), "line 3: the header has no element vertex"},
      {format, ply("element vertex 0\n" + xyz_properties, ""), "the file has no vertices"},
      {format, ply("element vertex -3\n", ""),
       "line 3: the count of element \"vertex\" is \"-3\"; expected a whole number"},
      {format, ply("element vertex 99999999999999999999\n", ""),
       "line 3: the count of element \"vertex\" is \"99999999999999999999\"; expected a whole "
       "number"},
      {format, ply("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"),
       "line 6: element vertex has no property z"},
      {format, ply("property float x\n", ""), "line 3: property before the first element"},
      {format, ply("element vertex 1\nproperty real x\n", ""),
       "line 4: property type is \"real\"; expected float, int, ..."},
      {format, ply("element vertex 1\nproperty float\n", ""), "line 4: property without a name"},
      {format, ply("element vertex 1\nproperty list float int x\n", ""),
       "line 4: the counts of a list are \"float\"; expected an integer type"},
      {format, ply("element vertex 1\nproperty float x\nproperty float x\n", ""),
       "line 5: property \"x\" stands twice"},
      {format, ply(vertex + "element vertex 1\n", ""), "line 7: element \"vertex\" stands twice"},
      {format, ply(vertex + "element void 4000000000\n", "0 0 0\n"), "line 8: element \"void\" has no properties"},
      {format, ply("elements vertex 1\n", ""),
       "line 3: found \"elements\"; expected format, element, property, comment, obj_info or "
       "end_header"},
      {format, ply("element vertex 3000000000\n" + xyz_properties, "0 0 0\n"),
       "line 9: the file ends after 1 of 3000000000 records of element \"vertex\""},
      {format, ply(vertex, "0 0\n"), "line 8: the line ends before \"z\""},
      {format, ply(vertex, "0 0 1 5\n"), "line 8: found \"5\" behind the 3 properties of element vertex"},
      {format, ply(vertex, "0 0 inf\n"), "line 8: z is \"inf\"; expected a finite decimal number"},
      {format, ply(lists, "0 0 0\n3 0 0 1\n"),
       "line 11: face refers to vertex 1; the file has 1 vertices, counted from 0"},
      {format, ply(lists, "0 0 0\n3 0 0 -1\n"), "line 11: face refers to vertex -1; expected whole numbers from 0 up"},
      {format, ply(lists, "0 0 0\n3 0 0 0.5\n"),
       "line 11: face refers to vertex 0.5; expected whole numbers from 0 up"},
      {format, ply(lists, "0 0 0\n4 0 0 0\n"), "line 11: the line ends before \"vertex_indices\""},
      {format, ply(lists, "0 0 0\n-1 0 0 0\n"),
       "line 11: the count of list \"vertex_indices\" is \"-1\"; expected a whole number"},
      {format, binary_ply(vertex, test::binary<float>({0, 0})),
       "byte 115: the file ends after 0 of 1 records of element \"vertex\""},
      {format, binary_ply("element vertex 4000000000\n" + xyz_properties, test::binary<float>({0, 0, 0})),
       "byte 136: the file ends after 1 of 4000000000 records of element \"vertex\""},
      {format, binary_ply(vertex, test::binary<float>({0, 0, HUGE_VALF})), "byte 115: z of vertex 0 is not finite"},
      {format,
       binary_ply(lists, test::binary<float>({0, 0, 0}) + "\xFF"
                                                          "abc"),
       "byte 181: the file ends after 0 of 1 records of element \"face\""},
      {format,
       binary_ply(vertex + "element face 1\nproperty list int int vertex_indices\n",
                  test::binary<float>({0, 0, 0}) + test::binary<std::int32_t>({-2, 0})),
       "byte 179: list \"vertex_indices\" has a negative count"},
      {format,
       binary_ply(vertex + "element face 1\nproperty list uint double vertex_indices\n",
                  test::binary<float>({0, 0, 0}) + test::binary<std::uint32_t>({0xFFFFFFFF, 0})),
       "byte 183: the file ends after 0 of 1 records of element \"face\""},
  };
}

std::vector<Malformed> other_files() {
  const auto off = FileFormat::off;
  const auto stl = FileFormat::stl;
  const auto xyz = FileFormat::xyz;
  std::string not_finite = binary_stl(1, 50);
  not_finite.replace(84 + 24, 4, test::binary<float>({HUGE_VALF}));
  return {
      {off, "", "line 1: expected OFF, found the end of the file"},
      {off, "4OFF\n", "line 1: expected OFF, COFF, NOFF or STOFF, found \"4OFF\""},
      {off, "OFF\n", "line 2: expected the numbers of vertices and faces"},
      {off, "OFF\n3 x\n", "line 2: expected the numbers of vertices and faces, found \"x\""},
      {off, "OFF BINARY\n", "line 1: expected the numbers of vertices and faces, found \"BINARY\""},
      {off, "OFF\n0 0 0\n", "the file has no vertices"},
      {off, "OFF\n3000000000 1 0\n0 0 0\n", "line 4: the file ends after 1 of 3000000000 vertices"},
      {off, "OFF\n1 2 0\n0 0 0\n3 0 0 0\n", "line 5: the file ends after 1 of 2 faces"},
      {off, "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "line 4: face refers to vertex \"1\"; expected ids from 0 to 0"},
      {off, "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", "line 4: face refers to vertex \"-1\"; expected ids from 0 to 0"},
      {off, "OFF\n1 1 0\n0 0 0\n900000000000 0 0 0\n", "line 4: face has 3 corners; expected 900000000000"},
      {off, "OFF\n1 1 0\n0 0 0\nx\n", "line 4: expected the number of corners, found \"x\""},
      {off, "NOFF\n1 0 0\n0 0 0 1\n", "line 3: expected 3 numbers of a normal"},
      {off, "STOFF\n1 0 0\n0 0 0 1 x\n", "line 3: expected 2 finite texture coordinates at the end"},
      {stl, "", "byte 0: the file is empty"},
      {stl, "solid s\nendsolid s\n", "the file has no vertices"},
      {stl, facet("vertex 0 0 0\nvertex 1 0 0\n"), "line 7: facet has 2 vertices; expected 3"},
      {stl, facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 x 0\n"),
       "line 6: y is \"x\"; expected a finite decimal number"},
      {stl, facet("normal 0 0 0\n"), "line 4: found \"normal\"; expected outer loop, vertex, endloop or endfacet"},
      {stl, "solid s\nvertex 0 0 0\n", "line 2: found \"vertex\"; expected solid, facet or endsolid"},
      {stl, "solid s\nfacet norm 0 0 0\n", "line 2: found \"norm\"; expected normal"},
      {stl, "solid s\nfacet normal 0 0\n", "line 2: expected 3 numbers of a normal"},
      {stl, "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "line 5: the file ends inside a facet"},
      {stl, std::string(10, '\0'), "byte 0: the file ends inside the header of a binary STL (10 of 84 bytes)"},
      {stl, binary_stl(0, 0), "the file has no vertices"},
      {stl, binary_stl(2, 99), "byte 134: the file ends inside facet 2 of 2"},
      {stl, binary_stl(0xFFFFFFFF, 50), "byte 134: the file ends inside facet 2 of 4294967295"},
      {stl, not_finite, "byte 84: vertex 2 of facet 1 is not finite"},
      {xyz, "", "the file has no vertices"},
      {xyz, "# only words\n\n", "the file has no vertices"},
      {xyz, "1 2 3\n4 5\n", "line 2: expected 3 coordinates, found 2"},
      {xyz, "X Y Z\n1 2 3\n", "line 1: x is \"X\"; expected a finite decimal number"},
      {xyz, "1,0 2,0 3,0\n", "line 1: x is \"1,0\"; expected a finite decimal number"},
      {xyz, "1 2 " + std::string(100, '9') + "x\n",
       "line 1: z is \"" + std::string(40, '9') + "...\"; expected a finite decimal number"},
  };
}

void check_all(const std::vector<Malformed>& files) {
  for (const Malformed& bad : files) {
    CAPTURE(bad.file);
    CHECK(test::complaint(bad.format, bad.file) == bad.complaint);
  }
}

TEST_CASE("malformed obj files are refused with the line and the reason") { check_all(obj_files()); }

TEST_CASE("malformed ply files are refused with the place and the reason") { check_all(ply_files()); }

TEST_CASE("malformed off, stl and xyz files are refused with the place and the reason") { check_all(other_files()); }

}  // namespace
}  // namespace pliant::io
