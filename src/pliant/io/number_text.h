// Decimal numbers, exactly: what is read is the double nearest to the text, and what is written is
// read back bit for bit. Neither depends on the locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "pliant/io/bytes.h"

namespace pliant::io {

/// The double nearest to `text`, which must be one decimal number from end to end:
/// [+-] digits [. digits] [e [+-] digits]. Nothing for any other text, "nan" and "inf" among them,
/// and for numbers beyond the range of a double.
std::optional<double> read_number(std::string_view text);

/// A whole number of at most 18 decimal digits without a sign.
std::optional<std::uint64_t> read_count(std::string_view text);

constexpr std::size_t kLongestNumber = 32;

/// Writes a finite number as printf's %.17g would: 17 significant digits, no trailing zeros. `to` has room for
/// kLongestNumber characters; returns how many there are.
std::size_t print_number(double value, char* to);

/// Appends a number so.
void append_number(Bytes& out, double value);

/// `count` numbers with a space between them.
void append_numbers(Bytes& out, const double* values, std::size_t count);

void append_count(Bytes& out, std::uint64_t value);

}  // namespace pliant::io
