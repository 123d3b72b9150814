#include "pliant/io/xyz.h"

#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

class XyzScanner final : public LineScanner {
 public:
  Status finish() override { return require_vertices(vertices_); }

 private:
  Status scan_line(std::string_view line, Draft& draft) override {
    std::size_t kept = 0;
    std::size_t at = 0;
    const std::string_view first = next_word(line, at);
    if (!first.empty() && !first.starts_with('#') && !first.starts_with("//")) {
      at = 0;
      Status status = take_point(line, kept, at, draft);
      if (!status.ok()) {
        return status;
      }
    }
    draft.keep(line.substr(kept));
    return {};
  }
};

}  // namespace

std::unique_ptr<Scanner> make_xyz_scanner() { return std::make_unique<XyzScanner>(); }

void write_xyz(std::span<const double> positions, Bytes& out) {
  for (std::size_t v = 0; v < positions.size(); v += 3) {
    append_numbers(out, &positions[v], 3);
    out.push_back('\n');
  }
}

}  // namespace pliant::io
