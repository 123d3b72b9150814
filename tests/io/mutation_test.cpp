// Files damaged at random, from a fixed seed: whatever comes of them, nothing crashes, hangs or
// reads out of bounds (the sanitizers watch), and what is accepted is a sound shape.
#include <random>

#include "io/io_support.h"

namespace pliant::io {
namespace {

class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  std::size_t below(std::size_t limit) { return random_() % limit; }

  std::string damaged(std::string file) {
    for (std::size_t i = 1 + below(4); i > 0 && !file.empty(); --i) damage(file);
    return file;
  }

 private:
  void damage(std::string& file) {
    constexpr const char* words[] = {"-1", "0", "4294967296", "1e400", "nan",  "\n",  "\r",  "\\\n",     "/",     "f",
                                     "v ", "3", "#",          " ",     "list", "999", "end", "\xFF\xFF", "facet", "-"};
    const std::size_t at = below(file.size());
    switch (below(6)) {
      case 0:
        file[at] = static_cast<char>(below(256));
        break;
      case 1:
        file[at] = static_cast<char>(file[at] ^ (1 << below(8)));
        break;
      case 2:
        file.erase(at, 1 + below(20));
        break;
      case 3:
        file.insert(at, words[below(std::size(words))]);
        break;
      case 4: {
        const std::size_t from = below(file.size());  // arguments have no order: one draw a line
        file.insert(at, file.substr(from, below(40)));
        break;
      }
      case 5:
        file.resize(at);
        break;
    }
  }

  std::mt19937 random_;
};

void check_sound(const Document& document) {
  const PolygonMesh& mesh = document.mesh();
  REQUIRE(mesh.vertex_count() > 0);
  REQUIRE(mesh.positions.size() % 3 == 0);
  for (const double value : mesh.positions) REQUIRE(value - value == 0.0);
  REQUIRE(mesh.face_offsets.front() == 0);
  REQUIRE(mesh.face_offsets.back() == mesh.face_vertices.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    REQUIRE(mesh.face_offsets[f] + 3 <= mesh.face_offsets[f + 1]);
  }
  for (const std::uint32_t id : mesh.face_vertices) REQUIRE(id < mesh.vertex_count());
  const std::size_t corners = mesh.corner_texcoords.size();
  REQUIRE((corners == 0 || corners == mesh.face_vertices.size()));
  for (const std::uint32_t id : mesh.corner_texcoords) {
    REQUIRE((id == PolygonMesh::kNoTexcoord || 2 * std::size_t{id} + 1 < mesh.texcoords.size()));
  }
  REQUIRE(document.triangles().size() == 3 * (mesh.face_vertices.size() - 2 * mesh.face_count()));
}

/// The file in two or three pieces; false when it was refused.
bool stream(FileFormat format, const Bytes& file, Mutator& random, Bytes& out) {
  Rewriter rewriter;
  rewriter.open(format);
  for (std::size_t at = 0;;) {
    const std::size_t size = std::min(file.size() - at, random.below(file.size() + 1) + 1);
    const bool last = at + size == file.size();
    if (!rewriter.push(ByteView(file).subspan(at, size), last).ok()) return false;
    if (!rewriter.emit(std::vector<double>(rewriter.points()), out).ok()) return false;
    if (last) return true;
    at += size;
  }
}

TEST_CASE("damaged files are refused or read as a sound shape; streaming agrees with reading") {
  const std::vector<test::Sample> samples = test::samples();
  Mutator mutator(7);
  int accepted = 0;
  for (int round = 0; round < 16000; ++round) {
    const test::Sample& sample = samples[static_cast<std::size_t>(round) % samples.size()];
    const std::string file = mutator.damaged(sample.file);
    CAPTURE(sample.name);
    CAPTURE(file);
    Document document;
    const Status status = document.read(sample.format, test::bytes_of(file));
    Bytes streamed;
    const bool passed = stream(sample.format, test::bytes_of(file), mutator, streamed);
    if (!status.ok()) {
      REQUIRE(!status.message().empty());
      continue;
    }
    ++accepted;
    check_sound(document);
    // Binary STL refuses nothing it read, text formats neither: what was read can be written.
    const Result<Bytes> again = document.write(sample.format, document.mesh().positions);
    REQUIRE_MESSAGE(again.ok(), again.status().message());
    REQUIRE(passed);
    REQUIRE(test::string_of(streamed) == test::string_of(*again));
    Document back;
    REQUIRE(back.read(sample.format, *again).ok());
    REQUIRE(test::same_bits(back.mesh().positions, document.mesh().positions));
    REQUIRE(back.mesh().face_vertices == document.mesh().face_vertices);
  }
  CHECK(accepted > 1000);
}

TEST_CASE("a file of one format is refused by the readers of the others") {
  for (const test::Sample& sample : test::samples()) {
    for (const FileFormat format : test::all_formats) {
      if (format == sample.format) continue;
      CAPTURE(sample.name);
      CHECK(test::complaint(format, sample.file) != "");
    }
  }
}

}  // namespace
}  // namespace pliant::io
