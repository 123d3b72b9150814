#include "pliant/io/document.h"

#include <limits>

#include "io/io_support.h"
#include "pliant/geometry/shape.h"

namespace pliant::io {
namespace {

using test::read;
using test::write;
using Ids = std::vector<std::uint32_t>;
using Numbers = std::vector<double>;

Numbers corner_texcoords(const PolygonMesh& mesh) {
  Numbers uv;
  for (std::size_t c = 0; c < mesh.corner_texcoords.size(); ++c) {
    for (const double value : mesh.corner_texcoord(c)) uv.push_back(value);
  }
  return uv;
}

/// A quad and a triangle with a vertex no face uses, coordinates that need 17 digits, and texture
/// coordinates with a seam.
Document awkward_document() {
  Document document;
  const Numbers positions = test::awkward_numbers(18);
  REQUIRE(document.assign(positions, std::vector<std::int32_t>{4, 0, 1, 2, 3, 3, 5, 3, 2}).ok());
  REQUIRE(document.assign_texcoords(test::awkward_numbers(14)).ok());
  return document;
}

TEST_CASE("obj: vertices in order, polygons, texture coordinates, relative ids, continued lines") {
  const Document document = read(FileFormat::obj, test::samples()[0].file);
  const PolygonMesh& mesh = document.mesh();
  CHECK(test::same_bits(mesh.positions, {0, 0, 0, 1.25, 0, -0.0, 1, 1, 0.5, 0, 1, 0, 2, 3, 4}));
  CHECK(mesh.face_vertices == Ids{0, 1, 2, 3, 4, 0, 1, 0, 1, 2, 4});
  CHECK(mesh.face_offsets == Ids{0, 4, 7, 11});
  CHECK(corner_texcoords(mesh) == Numbers{0, 0, 1, 0, 1, 1, 0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  CHECK(document.triangles().size() == 15);
}

TEST_CASE("obj: a face may stand before its vertices, texture ids differ from vertex ids") {
  const Document document = read(FileFormat::obj, "f 3/1 2/2 1/3\nvt 9 8\nv 0 0 0\nvt 7 6\nv 1 0 0\nvt 5 4\nv 0 1 0\n");
  CHECK(document.mesh().face_vertices == Ids{2, 1, 0});
  CHECK(corner_texcoords(document.mesh()) == Numbers{9, 8, 7, 6, 5, 4});
}

TEST_CASE("line endings of all systems") {
  const Numbers expected{1, 2, 3, 4, 5, 6};
  for (const char* file : {"v 1 2 3\nv 4 5 6", "v 1 2 3\r\nv 4 5 6\r\n", "v 1 2 3\rv 4 5 6\r"}) {
    CHECK(read(FileFormat::obj, file).mesh().positions == expected);
  }
  CHECK(test::complaint(FileFormat::obj, "v 1 2 3\r\n\rv 4\r\n") == "line 3: expected 3 coordinates, found 1");
}

TEST_CASE("ply: ascii and both binary encodings hold the same") {
  const std::vector<test::Sample> samples = test::samples();
  const PolygonMesh ascii = read(FileFormat::ply, samples[1].file).mesh();
  CHECK(ascii.positions == Numbers{0, 0, 0.5, 1.5, 0, 0, 1, 1, 0, 0, 1, 0});
  CHECK(ascii.face_vertices == Ids{0, 1, 2, 3, 0, 2, 3});
  CHECK(ascii.face_offsets == Ids{0, 4, 7});
  CHECK(corner_texcoords(ascii) == Numbers{0.25, 0.5, 0.75, 0.5, 1, 1, 0, 1, 0.25, 0.5, 1, 1, 0, 1});

  const PolygonMesh little = read(FileFormat::ply, samples[2].file).mesh();
  const PolygonMesh big = read(FileFormat::ply, samples[3].file).mesh();
  const Numbers positions{0, 0, 0, static_cast<double>(1.1f), 0, 0.1, 1, 300, 0.2, -0.0, -7, 0.1 * 3};
  for (const PolygonMesh& mesh : {little, big}) {
    CHECK(test::same_bits(mesh.positions, positions));
    CHECK(mesh.face_vertices == Ids{0, 1, 2, 3, 3, 2, 0});
    CHECK(mesh.face_offsets == Ids{0, 4, 7});
    CHECK(corner_texcoords(mesh) == Numbers{0, 0, 1, 0, 1, 1, 0, 0.5, 0, 0, 1, 0, 1, 1});
  }
}

TEST_CASE("ply: triangle strips, each second triangle turned around, -1 between strips") {
  const Document document =
      read(FileFormat::ply,
           "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
           "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 -1 4 3 2 -1\n");
  CHECK(document.mesh().face_vertices == Ids{0, 1, 2, 2, 1, 3, 4, 3, 2});
}

TEST_CASE("off: prefixes, comments, counts on the first line") {
  const PolygonMesh mesh = read(FileFormat::off, test::samples()[4].file).mesh();
  CHECK(mesh.positions == Numbers{0, 0, 0, 1, 0, 0.1, 1, 1, 0, 0, 1, 0});
  CHECK(mesh.face_vertices == Ids{0, 1, 2, 3, 0, 2, 3});
  CHECK(corner_texcoords(mesh) == Numbers{0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 1, 0, 1});
  for (const char* start : {"OFF\n3 1 0\n", "OFF 3 1\n", "OFF3 1 0\n", "COFF\n3 1 3\n"}) {
    const std::string file = std::string(start) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK(read(FileFormat::off, file).triangles() == Ids{0, 1, 2});
  }
}

TEST_CASE("stl: three vertices a facet, text and binary") {
  const PolygonMesh text = read(FileFormat::stl, test::samples()[5].file).mesh();
  CHECK(text.positions == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0});
  CHECK(text.face_vertices == Ids{0, 1, 2, 3, 4, 5});
  const PolygonMesh binary = read(FileFormat::stl, test::samples()[6].file).mesh();
  const double y = static_cast<double>(1.1f);
  CHECK(binary.positions == Numbers{0, 0, 0, 1, 0, 0, 0, y, 0, 0, 0, 0, 2.5, 0, 0, 0, y, 0});
}

TEST_CASE("points without faces") {
  CHECK(read(FileFormat::xyz, test::samples()[7].file).mesh().positions ==
        Numbers{0, 0, 0, 1.5, 2, 3, -1e-3, 2, 0.5, 4, 5, 6});
  for (const FileFormat format : {FileFormat::obj, FileFormat::ply, FileFormat::off}) {
    Document points;
    REQUIRE(points.assign(Numbers{1, 2, 3, 4, 5, 6}, {}).ok());
    const Document back = read(format, write(points, format, {1, 2, 3, 7, 8, 9}));
    CHECK(back.mesh().positions == Numbers{1, 2, 3, 7, 8, 9});
    CHECK(back.mesh().face_count() == 0);
    CHECK(back.triangles().empty());
  }
}

TEST_CASE("what one format writes another reads: positions bit for bit, order, polygons, uv") {
  const Document document = awkward_document();
  const PolygonMesh& mesh = document.mesh();
  for (const FileFormat format : {FileFormat::obj, FileFormat::ply, FileFormat::off}) {
    const Document back = read(format, write(document, format, mesh.positions));
    CHECK(test::same_bits(back.mesh().positions, mesh.positions));
    CHECK(back.mesh().face_vertices == mesh.face_vertices);
    CHECK(back.mesh().face_offsets == mesh.face_offsets);
    CHECK(back.triangles() == document.triangles());
    if (format != FileFormat::off) {
      CHECK(test::same_bits(corner_texcoords(back.mesh()), corner_texcoords(mesh)));
    }
  }
  const Document points = read(FileFormat::xyz, write(document, FileFormat::xyz, mesh.positions));
  CHECK(test::same_bits(points.mesh().positions, mesh.positions));
  const Document soup = read(FileFormat::stl, write(document, FileFormat::stl, mesh.positions));
  REQUIRE(soup.mesh().vertex_count() == document.triangles().size());
  for (std::size_t corner = 0; corner < document.triangles().size(); ++corner) {
    const std::size_t vertex = document.triangles()[corner];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto rounded = static_cast<float>(mesh.positions[3 * vertex + axis]);
      CHECK(soup.mesh().positions[3 * corner + axis] == static_cast<double>(rounded));
    }
  }
}

TEST_CASE("a chain through all formats with polygons changes nothing") {
  const Document first = awkward_document();
  const std::string obj = write(first, FileFormat::obj, first.mesh().positions);
  const Document a = read(FileFormat::obj, obj);
  const Document b = read(FileFormat::ply, write(a, FileFormat::ply, a.mesh().positions));
  const Document c = read(FileFormat::obj, write(b, FileFormat::obj, b.mesh().positions));
  CHECK(write(c, FileFormat::obj, c.mesh().positions) == obj);
}

TEST_CASE("every file written again in its format holds the new positions and what it held") {
  for (const test::Sample& sample : test::samples()) {
    CAPTURE(sample.name);
    const Document document = read(sample.format, sample.file);
    // Numbers a float holds, for binary STL.
    Numbers moved = document.mesh().positions;
    for (double& value : moved) value = static_cast<double>(static_cast<float>(0.7 * value + 0.3));
    const Document back = read(sample.format, write(document, sample.format, moved));
    CHECK(test::same_bits(back.mesh().positions, moved));
    CHECK(back.mesh().face_vertices == document.mesh().face_vertices);
    CHECK(back.mesh().face_offsets == document.mesh().face_offsets);
    CHECK(corner_texcoords(back.mesh()) == corner_texcoords(document.mesh()));
  }
}

TEST_CASE("binary stl written from a shape has normals of its facets") {
  Document document;
  REQUIRE(
      document.assign(Numbers{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 0}, std::vector<std::int32_t>{3, 0, 1, 2, 3, 0, 1, 3})
          .ok());
  const std::string file = write(document, FileFormat::stl, document.mesh().positions);
  REQUIRE(file.size() == 84 + 2 * 50);
  CHECK(file.substr(84, 12) == test::binary<float>({0, 0, 1}));
  CHECK(file.substr(134, 12) == test::binary<float>({0, 0, 0}));
}

TEST_CASE("polygons with more corners than a byte counts survive ply") {
  std::vector<std::int32_t> polygon{300};
  for (int i = 0; i < 300; ++i) polygon.push_back(i);
  Document document;
  REQUIRE(document.assign(test::awkward_numbers(900), polygon).ok());
  const Document back = read(FileFormat::ply, write(document, FileFormat::ply, document.mesh().positions));
  CHECK(back.mesh().face_vertices == document.mesh().face_vertices);
}

TEST_CASE("bad arguments are refused and leave the document as it was") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Document document;
  const auto refuse = [](const Status& status, ErrorCode code, const std::string& message) {
    CHECK(status.code() == code);
    CHECK(status.message() == message);
  };
  const auto shape = ErrorCode::invalid_shape;
  refuse(document.write(FileFormat::obj, Numbers{1, 2, 3}).status(), shape,
         "the document is empty; read or assign one first");
  refuse(document.assign(Numbers{}, {}), shape, "positions has 0 numbers; expected 3 a vertex and at least one vertex");
  refuse(document.assign(Numbers{1, 2, 3, 4}, {}), shape,
         "positions has 4 numbers; expected 3 a vertex and at least one vertex");
  refuse(document.assign(Numbers{1, 2, nan}, {}), shape, "positions[2] is NaN; expected a finite number");
  const Numbers three{0, 0, 0, 1, 0, 0, 0, 1, 0};
  using Polygons = std::vector<std::int32_t>;
  refuse(document.assign(three, Polygons{2, 0, 1}), shape,
         "polygon 0 has a count of 2; expected at least 3 corners, all of them in the list");
  refuse(document.assign(three, Polygons{3, 0, 1, 2, 4, 0, 1}), shape,
         "polygon 1 has a count of 4; expected at least 3 corners, all of them in the list");
  refuse(document.assign(three, Polygons{3, 0, 1, 3}), shape,
         "polygon 0 refers to vertex 3; the shape has 3 vertices, counted from 0");
  refuse(document.assign(three, Polygons{3, 0, 1, -1}), shape,
         "polygon 0 refers to vertex -1; the shape has 3 vertices, counted from 0");
  REQUIRE(document.assign(three, Polygons{3, 0, 1, 2}).ok());
  refuse(document.assign_texcoords(Numbers{1, 2}), shape,
         "texture coordinates has 2 numbers; expected 2 for each of 3 corners");
  refuse(document.assign_texcoords(Numbers{1, 2, 3, nan, 5, 6}), shape,
         "texture coordinates[3] is NaN; expected a finite number");
  refuse(document.write(FileFormat::obj, Numbers{1, 2, 3}).status(), shape,
         "positions has 1 vertices; the document has 3");
  refuse(document.write(FileFormat::stl, Numbers{1, 2, 3, 4, 5, 6, 7, 8, -1e39}).status(), shape,
         "coordinate -1e+39 does not fit the 32-bit numbers of binary STL");
  REQUIRE_FALSE(document.read(FileFormat::obj, test::bytes_of("v 1 2\n")).ok());
  CHECK(document.mesh().positions == three);
  REQUIRE(document.read(FileFormat::xyz, test::bytes_of("1 2 3\n")).ok());
  refuse(document.write(FileFormat::stl, Numbers{1, 2, 3}).status(), shape,
         "the shape has no faces; expected some, since STL holds nothing else");
  CHECK(format_from_name("OBJ").status().message() == "format is \"OBJ\"; expected obj, ply, off, stl or xyz");
}

TEST_CASE("more vertices than a shape may have are refused while reading") {
  const std::size_t count = std::size_t{Shape::kMaxVertices} + 1;
  std::string file = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
                     "\nproperty char x\nproperty char y\nproperty char z\nend_header\n";
  file.resize(file.size() + 3 * count);
  Document document;
  const Status status = document.read(FileFormat::ply, test::bytes_of(file));
  CHECK(status.code() == ErrorCode::too_large);
}

TEST_CASE("colours: shares, bytes and other whole numbers; vertices without any are white") {
  using Colors = std::vector<std::uint8_t>;
  const auto colors_of = [](FileFormat format, const char* file) { return read(format, file).mesh().colors; };
  CHECK(colors_of(FileFormat::obj, "v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0\n") ==
        Colors{255, 255, 255, 255, 128, 0, 255, 255, 255});
  CHECK(colors_of(FileFormat::obj, "v 0 0 0 51 102 255 # so\nv 1 0 0 2.0\n") == Colors{51, 102, 255, 255, 255, 255});
  CHECK(colors_of(FileFormat::obj, "v 0 0 0 1\nv 1 0 0 a b c\n").empty());
  CHECK(colors_of(FileFormat::off, "COFF 2 0 0\n0 0 0 1 0 0 0.5\n1 0 0 0 0 1 1\n") == Colors{255, 0, 0, 0, 0, 255});
  CHECK(colors_of(FileFormat::off, "STCOFF 1 0 0\n0 0 0 10 20 30 255 0.5 0.75\n") == Colors{10, 20, 30});
  CHECK(colors_of(FileFormat::off, "OFF 1 0 0\n0 0 0 10 20 30\n").empty());
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  CHECK(colors_of(FileFormat::ply, (ply + "property uchar blue\nproperty ushort green\nproperty float red\nend_header\n"
                                          "0 0 0 255 13107 0.2\n")
                                       .c_str()) == Colors{51, 51, 255});
  CHECK(colors_of(FileFormat::ply, (ply + "property uchar red\nend_header\n0 0 0 255\n").c_str()).empty());
  CHECK(colors_of(FileFormat::ply, (ply + "property float red\nproperty float green\nproperty float blue\nend_header\n"
                                          "0 0 0 nan -1 7\n")
                                       .c_str()) == Colors{0, 0, 255});
}

TEST_CASE("colours go from format to format, every byte as it was") {
  Document document;
  std::vector<std::uint8_t> colors;
  for (int byte = 0; byte < 256; ++byte) colors.insert(colors.end(), {std::uint8_t(byte), std::uint8_t(255 - byte), 7});
  const Numbers positions = test::awkward_numbers(3 * 256);
  REQUIRE(document.assign(positions, {}).ok());
  REQUIRE(document.assign_colors(colors).ok());
  for (const FileFormat format : {FileFormat::obj, FileFormat::ply, FileFormat::off}) {
    CHECK(read(format, write(document, format, positions)).mesh().colors == colors);
  }
  CHECK(document.assign_colors(std::vector<std::uint8_t>(5)).message() ==
        "colors has 5 numbers; expected 3 for each of 256 vertices");
}

TEST_CASE("in pieces: the fraction grows to 1, the document before stays until then, the result is that of one read") {
  std::string file;
  for (int v = 0; v < 150'000; ++v) file += "v 1.5 " + std::to_string(v) + " 3\n";
  file += "f 1 2 3 150000\n";
  Document document = awkward_document();
  REQUIRE(document.begin(FileFormat::obj, test::bytes_of(file)).ok());
  double before = 0.0;
  int pieces = 0;
  for (double fraction = 0.0; fraction < 1.0; ++pieces) {
    CHECK(document.mesh().vertex_count() == 6);
    const Result<double> advanced = document.advance();
    REQUIRE(advanced.ok());
    fraction = *advanced;
    CHECK(fraction > before);
    before = fraction;
  }
  CHECK(pieces > 3);
  CHECK(document.mesh().positions == read(FileFormat::obj, file).mesh().positions);
  CHECK(document.advance().status().code() == ErrorCode::invalid_option);

  REQUIRE(document.begin(FileFormat::obj, test::bytes_of(file + "f 1 2 150001\n")).ok());
  Status status;
  while (status.ok()) status = document.advance().status();
  CHECK(status.message() == "line 150002: face refers to vertex 150001; the file has 150000 vertices");
  CHECK(document.mesh().vertex_count() == 150'000);
}

}  // namespace
}  // namespace pliant::io
