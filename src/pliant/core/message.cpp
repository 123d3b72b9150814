#include "pliant/core/message.h"

#include <cmath>

namespace pliant {
namespace {

/// `number` below 1e15 with at most `decimals` digits behind the point. (printf would cost WASM 4 kB.)
void append_fixed(std::string& out, double number, int decimals) {
  std::uint64_t scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  const auto scaled = static_cast<std::uint64_t>(std::round(number * static_cast<double>(scale)));
  out += std::to_string(scaled / scale);
  std::uint64_t rest = scaled % scale;
  if (rest == 0) return;
  out += '.';
  while (rest > 0) {
    scale /= 10;
    out += static_cast<char>('0' + rest / scale);
    rest %= scale;
  }
}

/// Behind the point of a number between 1e-6 and 1e15 that is to have six significant digits.
int decimals_of(double number) {
  int decimals = 5;
  for (double limit = 10.0; number >= limit && decimals > 0; limit *= 10.0) --decimals;
  for (double limit = 1.0; number < limit && decimals < 11; limit /= 10.0) ++decimals;
  return decimals;
}

void append_scientific(std::string& out, double number) {
  int exponent = 0;
  for (; number >= 9.999995; number /= 10.0) ++exponent;  // what would be rounded to 10
  for (; number < 0.9999995; number *= 10.0) --exponent;
  append_fixed(out, number, 5);
  out += exponent < 0 ? "e-" : "e+";
  out += std::to_string(std::abs(exponent));
}

void append_real(std::string& out, double number) {
  if (std::isnan(number)) {
    out += "NaN";
    return;
  }
  if (number < 0.0) out += '-';
  const double size = std::abs(number);
  if (std::isinf(size)) {
    out += "Infinity";
  } else if (size == 0.0 || (size >= 1e-6 && size < 1e15)) {
    append_fixed(out, size, size == std::floor(size) ? 0 : decimals_of(size));
  } else {
    append_scientific(out, size);
  }
}

}  // namespace

void Word::append_to(std::string& out) const {
  if (kind_ == Kind::text) out += text_;
  if (kind_ == Kind::whole) out += std::to_string(whole_);
  if (kind_ == Kind::real) append_real(out, real_);
}

std::string message(Words words) {
  std::string out;
  for (const Word& word : words) {
    word.append_to(out);
  }
  return out;
}

}  // namespace pliant
