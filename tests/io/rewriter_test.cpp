#include "pliant/io/rewriter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/io_support.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

using Numbers = std::vector<double>;

/// Streams the file through in pieces; each coordinate becomes half of it plus a quarter.
std::string rewritten(FileFormat format, const std::string& file, std::size_t piece, Numbers* found = nullptr) {
  Rewriter rewriter;
  rewriter.open(format);
  const Bytes bytes = test::bytes_of(file);
  Bytes out;
  for (std::size_t at = 0;; at += piece) {
    const std::size_t size = std::min(piece, bytes.size() - at);
    const bool last = at + size == bytes.size();
    const Status pushed = rewriter.push(ByteView(bytes).subspan(at, size), last);
    REQUIRE_MESSAGE(pushed.ok(), pushed.message());
    CHECK(rewriter.points().size() % 3 == 0);
    if (found) found->insert(found->end(), rewriter.points().begin(), rewriter.points().end());
    Numbers moved = rewriter.points();
    for (double& value : moved) value = 0.5 * value + 0.25;
    REQUIRE(rewriter.emit(moved, out).ok());
    if (last) return test::string_of(out);
  }
}

TEST_CASE("pieces of any size give the same file, and the points of the document") {
  for (const test::Sample& sample : test::samples()) {
    CAPTURE(sample.name);
    const Document document = test::read(sample.format, sample.file);
    Numbers moved = document.mesh().positions;
    for (double& value : moved) value = 0.5 * value + 0.25;
    const std::string expected = test::write(document, sample.format, moved);
    for (const std::size_t piece : {1, 2, 7, 64, 4096, 1 << 20}) {
      CAPTURE(piece);
      Numbers found;
      CHECK(rewritten(sample.format, sample.file, piece, &found) == expected);
      CHECK(test::same_bits(found, document.mesh().positions));
    }
  }
}

TEST_CASE("a long file comes out whole, whatever the pieces") {
  const Numbers numbers = test::awkward_numbers(30'000);
  std::string file;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    Bytes line = test::bytes_of("v ");
    append_numbers(line, &numbers[i], 3);
    file += test::string_of(line) + "\n# " + std::to_string(i) + "\n";
  }
  Numbers found;
  const std::string whole = rewritten(FileFormat::obj, file, file.size(), &found);
  CHECK(test::same_bits(found, numbers));
  for (const std::size_t piece : {7, 4096}) {
    CHECK(rewritten(FileFormat::obj, file, piece) == whole);
  }
  const Document document = test::read(FileFormat::obj, file);
  CHECK(test::write(document, FileFormat::obj, numbers) == file);
}

TEST_CASE("obj: every byte stays but the coordinates and the normals") {
  CHECK(rewritten(FileFormat::obj, test::samples()[0].file, 4096) ==
        "\xEF\xBB\xBF# a quad, a triangle and a line\r\n"
        "mtllib some file.mtl\r\n"
        "o Thing\r\n"
        "v 0.25 0.25 0.25 1 0.5 0.25\r\n"
        "  v\t0.875  0.25 0.25 # a comment\r\n"
        "v 0.75 0.75 0.5\r\n"
        "v 0.25 0.75 0.25 1.0\r\n"
        "vt 0 0\nvt 1 0 0\nvt 1 1\nvt 0.1\n"
        "g front  \\\n"
        "usemtl red\ns 1\n"
        "f 1/1 2/2 3/3 4/4 # the quad\n"
        "v 1.25 \\\n  1.75 \\\r\n 2.25\n"
        "f -1 1 -4# 5//5\n"
        "\n"
        "l 1 2 3\n"
        "f 1 2 \\\n 3 5");
}

TEST_CASE("ply ascii: coordinates become double, normals go, everything else stays") {
  CHECK(rewritten(FileFormat::ply, test::samples()[1].file, 4096) ==
        "ply\nformat ascii 1.0\ncomment made by hand\nobj_info nothing\n"
        "element vertex 4\n"
        "property uchar red\nproperty double x\nproperty double y\n"
        "property double z\nproperty list uchar int tags\n"
        "property float u\nproperty float v\n"
        "element face 3\nproperty list uchar uint vertex_indices\nproperty uchar flag\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
        "end_header\n"
        "255 0.25 0.25 0.5 0 0.25 0.5\n"
        "0 1 0.25 0.25 2 7 8 0.75 0.5\n"
        "\n"
        "1  0.75  0.75  0.25  0  1 1\n"
        "2 0.25 0.75 0.25 1 9 0 1  \n"
        "4 0 1 2 3 1\n"
        "3 0 2 3 0\n"
        "2 0 1 0\n"
        "0 1\n"
        "trailing words\n");
}

TEST_CASE("ply binary: coordinates become double, normals go, everything else stays") {
  for (const bool big : {false, true}) {
    const std::string file = test::samples()[big ? 3 : 2].file;
    std::string expected = file.substr(0, file.find("property float x"));
    expected +=
        "property double x\r\nproperty double y\r\nproperty uchar red\r\n"
        "property double z\r\n" +
        file.substr(file.find("element face"), file.find("end_header") + 12 - file.find("element face"));
    const float xs[] = {0.0f, 1.1f, 1.0f, -0.0f};
    const double ys[] = {0, 0, 300, -7};
    for (int i = 0; i < 4; ++i) {
      expected += test::binary<double>({0.5 * static_cast<double>(xs[i]) + 0.25}, big) +
                  test::binary<double>({0.5 * ys[i] + 0.25}, big) + "\x0A" +
                  test::binary<double>({0.5 * (0.1 * i) + 0.25}, big);
    }
    const std::size_t body = file.find("end_header") + 12;
    expected += file.substr(body + 4 * 19);
    CHECK(rewritten(FileFormat::ply, file, 4096) == expected);
  }
}

/// The whole file at once, with every normal turned around.
std::string with_normals(const std::string& file) {
  Rewriter rewriter;
  rewriter.open(FileFormat::ply, {.normals = true});
  const Status pushed = rewriter.push(test::bytes_of(file), true);
  REQUIRE_MESSAGE(pushed.ok(), pushed.message());
  Numbers normals = rewriter.normals();
  for (double& value : normals) value = 0.0 - value;
  Bytes out;
  REQUIRE(rewriter.emit(rewriter.points(), normals, out).ok());
  return test::string_of(out);
}

TEST_CASE("ply: normals that are asked for stay with their type and place") {
  const std::string header =
      "element vertex 1\nproperty float nz\nproperty double z\nproperty double x\nproperty float nx\n"
      "property double ny\nproperty double y\nend_header\n";
  const std::string ascii = "ply\nformat ascii 1.0\n" + header;
  CHECK(with_normals(ascii + "1 3 1  0.5 -2 2 \n") == ascii + "-1 3 1  -0.5 2 2 \n");
  for (const bool big : {false, true}) {
    const std::string start = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + header;
    const auto record = [big](float sign) {
      return test::binary<float>({sign}, big) + test::binary<double>({3, 1}, big) +
             test::binary<float>({0.5f * sign}, big) + test::binary<double>({-2.0 * static_cast<double>(sign), 2}, big);
    };
    CHECK(with_normals(start + record(1)) == start + record(-1));
    CHECK(test::read(FileFormat::ply, start + record(1)).mesh().positions ==
          Numbers{1, 2, 3});  // by name, not by order
  }
  const std::string whole =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
      "property double z\nproperty char nx\nproperty char ny\nproperty char nz\nend_header\n1 2 3 0 0 9\n";
  CHECK(with_normals(whole).ends_with("property double z\nend_header\n1 2 3\n"));  // no room for a turned one
}

TEST_CASE("a coordinate beyond what is asked for, and a face of vertices that are not there, have a place") {
  const auto complaint = [](FileFormat format, const char* file) {
    Rewriter rewriter;
    rewriter.open(format, {.largest = 10.0});
    return rewriter.push(test::bytes_of(file), true).message();
  };
  CHECK(complaint(FileFormat::xyz, "1 2 10\n1 -11 3\n") == "line 2: coordinate -11; expected at most 10 in magnitude");
  CHECK(complaint(FileFormat::obj, "v 1 2 3\nf 1 1 3\nf 1 1 2\n") ==
        "line 2: face refers to vertex 3; the file has 1 vertices");
  CHECK(complaint(FileFormat::obj, "f 1 1 2\nv 1 2 3\nv 1 2 3\n").empty());
  CHECK(complaint(FileFormat::ply,
                  "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 2\n"
                  "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n1 2 3\n1 2 3\n") ==
        "line 10: face refers to vertex 2; the file has 2 vertices, counted from 0");
}

TEST_CASE("off: normals go and the N of the header with them") {
  CHECK(rewritten(FileFormat::off, test::samples()[4].file, 4096) ==
        "# first a comment\nSTCOFF # with everything\n\n4 2 0\n"
        "0.25 0.25 0.25  255 0 0 255  0 0\n"
        "  0.75 0.25 0.29999999999999999  255 0 0 255  1 0 # second\n"
        "# between\n"
        "0.75 0.75 0.25  255 0 0 255  1 1\n"
        "0.25 0.75 0.25  255 0 0 255  0 1\r\n"
        "4 0 1 2 3  255 255 255\n"
        "3 0 2 3\n"
        "# at the end");
}

TEST_CASE("off: what stands close together without normals can still be read") {
  const auto written = [](const std::string& file) {
    const std::string out = rewritten(FileFormat::off, file, 1000);
    CHECK(test::read(FileFormat::off, out).mesh().vertex_count() == 1);
    CHECK(test::string_of(*test::read(FileFormat::off, out).write(FileFormat::off, Numbers{0.75, 1.25, 1.75})) == out);
    return out;
  };
  CHECK(written("NOFF1 0\n1 2 3 0 0 1\n") == "OFF 1 0\n0.75 1.25 1.75\n");
  CHECK(written("STCNOFF1 0 0 # one\n1 2 3 0 0 1 9 9 9 0 0\n") == "STCOFF 1 0 0 # one\n0.75 1.25 1.75 9 9 9 0 0\n");
  CHECK(written("OFF1 0\n1 2 3 #one\n") == "OFF 1 0\n0.75 1.25 1.75 #one\n");
  CHECK(written("NOFF 1 0\n1 2 3 0 0 1#one\n") == "OFF 1 0\n0.75 1.25 1.75 #one\n");
}

TEST_CASE("stl: normals are those of the new corners") {
  CHECK(rewritten(FileFormat::stl, test::samples()[5].file, 4096) ==
        "solid two facets\n"
        "  facet normal 0 0 1\n    outer loop\n"
        "      vertex 0.25 0.25 0.25\n      vertex 0.75 0.25 0.25\n"
        "      vertex 0.25 0.75 0.25\n    endloop\n  endfacet\n"
        "\n"
        "FACET NORMAL 0 0 0\nOUTER LOOP\nVERTEX 0.25 0.25 0.25\n"
        " VERTEX 0.25 0.25 0.29999999999999999\nVERTEX 0.25 0.25 0.25\nENDLOOP\nENDFACET\r\n"
        "endsolid two facets\nsolid again\nendsolid again\n");
  const std::string binary = rewritten(FileFormat::stl, test::samples()[6].file, 4096);
  const float y = static_cast<float>(0.5 * static_cast<double>(1.1f) + 0.25);
  CHECK(binary.substr(0, 84) == test::samples()[6].file.substr(0, 84));
  CHECK(binary.substr(84, 50) ==
        test::binary<float>({0, 0, 1, 0.25f, 0.25f, 0.25f, 0.75f, 0.25f, 0.25f, 0.25f, y, 0.25f}) + "ab");
  CHECK(binary.substr(184) == "tail");
}

TEST_CASE("xyz: further columns, comments and blanks stay") {
  CHECK(rewritten(FileFormat::xyz, test::samples()[7].file, 4096) ==
        "# points\n// of a scan\n\n0.25 0.25 0.25\n 1\t1.25 1.75  0 0 1  255 0 0\r\n"
        "0.2495 1.25 0.5 words too\n2.25 2.75 3.25");
}

TEST_CASE("a facet normal is right for corners of any size") {
  for (const double size : {1e-300, 1.0, 1e300}) {
    Draft draft;
    for (int component = 0; component < 3; ++component) draft.facet_normal(component);
    draft.keep("|");
    for (int i = 0; i < 9; ++i) draft.coordinate(0);
    draft.set_style(NumberStyle::double_little);
    Bytes out;
    REQUIRE(draft.emit(Numbers{0, 0, 0, 0, size, 0, 0, 0, size}, out).ok());
    CHECK(test::string_of(out).substr(0, 24) == test::binary<double>({1, 0, 0}));
  }
}

TEST_CASE("errors of a stream name the place, and the next file works") {
  Rewriter rewriter;
  Bytes out;
  rewriter.open(FileFormat::obj);
  REQUIRE(rewriter.push(test::bytes_of("v 1 2 3\nv 1 2"), false).ok());
  CHECK(rewriter.points() == Numbers{1, 2, 3});
  REQUIRE(rewriter.emit(Numbers{1, 2, 3}, out).ok());
  const Status status = rewriter.push(test::bytes_of(" x\n"), false);
  CHECK(status.code() == ErrorCode::parse_error);
  CHECK(status.message() == "line 2: z is \"x\"; expected a finite decimal number");
  CHECK(rewriter.points().empty());
  CHECK(rewriter.push(test::bytes_of("v 1 2 3\n"), true).code() == ErrorCode::invalid_option);
  rewriter.open(FileFormat::obj);
  CHECK(rewriter.push(test::bytes_of("v 1 2 3\n"), true).ok());
}

TEST_CASE("calls out of turn and wrong coordinates are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Rewriter rewriter;
  Bytes out;
  CHECK(rewriter.push({}, false).message() == "push without an open file");
  CHECK(rewriter.emit({}, out).message() == "emit without a push before it");
  rewriter.open(FileFormat::xyz);
  CHECK(rewriter.emit({}, out).message() == "emit without a push before it");
  REQUIRE(rewriter.push(test::bytes_of("1 2 3\n"), true).ok());
  CHECK(rewriter.push({}, true).message() == "push before the last piece was emitted");
  CHECK(rewriter.emit(Numbers{1, 2}, out).message() == "positions has 2 numbers; expected 3");
  CHECK(rewriter.emit(Numbers{1, nan, 3}, out).message() == "positions[1] is NaN; expected a finite number");
  CHECK(rewriter.emit(Numbers{1, 2, -HUGE_VAL}, out).message() ==
        "positions[2] is -Infinity; expected a finite number");
  CHECK(out.empty());
  REQUIRE(rewriter.emit(Numbers{4, 5, 6}, out).ok());
  CHECK(test::string_of(out) == "4 5 6\n");
  CHECK(rewriter.push({}, true).message() == "push without an open file");
}

TEST_CASE("an emit that does not fit writes nothing and can be called again") {
  Rewriter rewriter;
  Bytes out = test::bytes_of("before");
  rewriter.open(FileFormat::stl);
  REQUIRE(rewriter.push(test::bytes_of(test::samples()[6].file), true).ok());
  Numbers points = rewriter.points();
  points[4] = 1e39;
  CHECK(rewriter.emit(points, out).code() == ErrorCode::invalid_shape);
  CHECK(test::string_of(out) == "before");
  points[4] = 1;
  CHECK(rewriter.emit(points, out).ok());
}

TEST_CASE("memory is bounded: a record beyond the limit is an error") {
  Rewriter rewriter;
  Bytes out;
  rewriter.open(FileFormat::obj);
  const Bytes piece(1 << 20, '#');
  Status status;
  std::size_t pushed = 0;
  while (status.ok() && pushed < 2 * Rewriter::kMaxRecord) {
    status = rewriter.push(piece, false);
    pushed += piece.size();
    if (status.ok()) REQUIRE(rewriter.emit({}, out).ok());
  }
  CHECK(status.message() == "line 1: a record of more than 16777216 bytes");
  CHECK(pushed <= Rewriter::kMaxRecord + piece.size());
}

TEST_CASE("a truncated stream is an error at its end, not before") {
  for (const test::Sample& sample : test::samples()) {
    if (sample.format == FileFormat::obj || sample.format == FileFormat::xyz) continue;
    CAPTURE(sample.name);
    Rewriter rewriter;
    rewriter.open(sample.format);
    const std::string half = sample.file.substr(0, sample.file.size() / 2);
    Bytes out;
    REQUIRE(rewriter.push(test::bytes_of(half), false).ok());
    REQUIRE(rewriter.emit(Numbers(rewriter.points()), out).ok());
    CHECK(rewriter.push({}, true).code() == ErrorCode::parse_error);
  }
}

}  // namespace
}  // namespace pliant::io
