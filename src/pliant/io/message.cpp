#include "pliant/io/message.h"

#include "pliant/io/number_text.h"

namespace pliant::io {

void Piece::append_to(std::string& out) const {
  if (kind_ == Kind::text) {
    out += text_;
  }
  if (kind_ == Kind::whole) {
    out += std::to_string(whole_);
  }
  if (kind_ == Kind::real) {
    Bytes digits;
    append_number(digits, real_);
    out += text_of(digits);
  }
}

std::string message(Pieces pieces) {
  std::string out;
  for (const Piece& piece : pieces) {
    piece.append_to(out);
  }
  return out;
}

}  // namespace pliant::io
