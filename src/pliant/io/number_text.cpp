#include "pliant/io/number_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace pliant::io {
namespace {

/// mantissa * 10^exponent; `exact` when every digit of the text went into the mantissa.
struct Decimal {
  std::uint64_t mantissa = 0;
  int exponent = 0;
  bool negative = false;
  bool exact = true;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes digits from `at` on into the mantissa; returns how many characters were digits.
int take_digits(std::string_view text, std::size_t& at, Decimal& decimal, bool after_point) {
  constexpr std::uint64_t room_for_one_more = (UINT64_MAX - 9) / 10;
  int count = 0;
  for (; at < text.size() && is_digit(text[at]); ++at, ++count) {
    if (decimal.mantissa <= room_for_one_more) {
      decimal.mantissa = 10 * decimal.mantissa + static_cast<std::uint64_t>(text[at] - '0');
      decimal.exponent -= after_point ? 1 : 0;
    } else {
      decimal.exact = decimal.exact && text[at] == '0';
      decimal.exponent += after_point ? 0 : 1;
    }
  }
  return count;
}

bool take_exponent(std::string_view text, std::size_t& at, Decimal& decimal) {
  constexpr int beyond_any_double = 100'000;
  ++at;
  const bool negative = at < text.size() && text[at] == '-';
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) {
    ++at;
  }
  const std::size_t first = at;
  int exponent = 0;
  for (; at < text.size() && is_digit(text[at]); ++at) {
    exponent = std::min(10 * exponent + (text[at] - '0'), beyond_any_double);
  }
  decimal.exponent += negative ? -exponent : exponent;
  return at > first;
}

std::optional<Decimal> parse_decimal(std::string_view text) {
  Decimal decimal;
  std::size_t at = 0;
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) {
    decimal.negative = text[at++] == '-';
  }
  int digits = take_digits(text, at, decimal, false);
  if (at < text.size() && text[at] == '.') {
    digits += take_digits(text, ++at, decimal, true);
  }
  if (digits == 0) {
    return std::nullopt;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E') && !take_exponent(text, at, decimal)) {
    return std::nullopt;
  }
  if (at != text.size()) {
    return std::nullopt;
  }
  return decimal;
}

__extension__ using Wide = unsigned __int128;

constexpr int kLargestExactPower = 27;  // 5^27 < 2^63

constexpr std::array<std::uint64_t, kLargestExactPower + 1> powers_of_five() {
  std::array<std::uint64_t, kLargestExactPower + 1> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) {
    powers[i] = 5 * powers[i - 1];
  }
  return powers;
}

/// The double nearest to (value + a little, if `inexact`) * 2^exponent, ties to even; value > 0 and
/// the result within the range of normal doubles.
double round_to_double(Wide value, bool inexact, int exponent) {
  const auto high = static_cast<std::uint64_t>(value >> 64);
  const int bits = high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(std::uint64_t(value));
  const int shift = bits - 53;
  if (shift <= 0) {
    return std::ldexp(static_cast<double>(std::uint64_t(value)), exponent);
  }
  const Wide half = Wide{1} << (shift - 1);
  const Wide rest = value & (2 * half - 1);
  auto kept = static_cast<std::uint64_t>(value >> shift);
  if (rest > half || (rest == half && (inexact || kept % 2 == 1))) {
    ++kept;
  }
  return std::ldexp(static_cast<double>(kept), exponent + shift);
}

/// Numbers as files have them, at most 19 digits and a small power of ten, in integers: 10^k is
/// 5^k 2^k, so the product, or the quotient and whether it left a remainder, is exact in 128 bits.
/// Nothing for other numbers. In WASM several times as fast as strtod.
std::optional<double> convert_in_integers(const Decimal& decimal) {
  constexpr auto powers = powers_of_five();
  if (!decimal.exact || std::abs(decimal.exponent) > kLargestExactPower) {
    return std::nullopt;
  }
  if (decimal.mantissa == 0) {
    return 0.0;
  }
  if (decimal.exponent >= 0) {
    const Wide product = Wide{decimal.mantissa} * powers[std::size_t(decimal.exponent)];
    return round_to_double(product, false, decimal.exponent);
  }
  const int lift = std::countl_zero(decimal.mantissa);
  const Wide dividend = Wide{decimal.mantissa << lift} << 64;
  const std::uint64_t divisor = powers[std::size_t(-decimal.exponent)];
  const Wide quotient = dividend / divisor;
  const bool inexact = quotient * divisor != dividend;
  return round_to_double(quotient, inexact, decimal.exponent - 64 - lift);
}

/// The library's own correctly rounded conversion. musl, which WASM uses, has no locale and libc++
/// no from_chars for doubles; elsewhere strtod would depend on the locale.
double convert(std::string_view digits) {
#if defined(__cpp_lib_to_chars)
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    // from_chars leaves the value alone both for too large and for too small.
    const std::optional<Decimal> decimal = parse_decimal(digits);
    return decimal->exponent < 0 ? 0.0 : HUGE_VAL;
  }
  return value;
#else
  return std::strtod(std::string(digits).c_str(), nullptr);
#endif
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
  const std::optional<Decimal> decimal = parse_decimal(text);
  if (!decimal) {
    return std::nullopt;
  }
  double value = 0.0;
  if (const std::optional<double> fast = convert_in_integers(*decimal)) {
    value = *fast;
  } else {
    value = convert(text.substr(text.front() == '-' || text.front() == '+' ? 1 : 0));
  }
  if (!std::isfinite(value)) {
    return std::nullopt;
  }
  return decimal->negative ? -value : value;
}

std::optional<std::uint64_t> read_count(std::string_view text) {
  if (text.empty() || text.size() > 18 || !std::all_of(text.begin(), text.end(), is_digit)) {
    return std::nullopt;
  }
  std::uint64_t value = 0;
  for (const char c : text) {
    value = 10 * value + static_cast<std::uint64_t>(c - '0');
  }
  return value;
}

std::size_t print_number(double value, char* to) {
#if defined(__cpp_lib_to_chars)
  const auto [end, error] = std::to_chars(to, to + kLongestNumber, value, std::chars_format::general, 17);
  return static_cast<std::size_t>(end - to);
#else
  return static_cast<std::size_t>(std::snprintf(to, kLongestNumber, "%.17g", value));
#endif
}

void append_number(Bytes& out, double value) {
  char text[kLongestNumber];
  out.insert(out.end(), text, text + print_number(value, text));
}

void append_numbers(Bytes& out, const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) {
      out.push_back(' ');
    }
    append_number(out, values[i]);
  }
}

void append_count(Bytes& out, std::uint64_t value) {
  char text[20];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  out.insert(out.end(), text, end);
}

}  // namespace pliant::io
