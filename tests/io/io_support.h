// Files in memory, for the tests of io.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "pliant/io/document.h"
#include "pliant/io/rewriter.h"

namespace pliant::io::test {

inline Bytes bytes_of(std::string_view text) { return Bytes(text.begin(), text.end()); }

inline std::string string_of(ByteView bytes) { return std::string(text_of(bytes)); }

inline Document read(FileFormat format, std::string_view file) {
  Document document;
  const Status status = document.read(format, bytes_of(file));
  REQUIRE_MESSAGE(status.ok(), status.message());
  return document;
}

inline std::string write(const Document& document, FileFormat format, const std::vector<double>& positions) {
  const Result<Bytes> bytes = document.write(format, positions);
  REQUIRE_MESSAGE(bytes.ok(), bytes.status().message());
  return string_of(*bytes);
}

/// What reading the file says; "" when it is accepted.
inline std::string complaint(FileFormat format, std::string_view file) {
  Document document;
  const Status status = document.read(format, bytes_of(file));
  if (status.ok()) return "";
  CHECK(status.code() == ErrorCode::parse_error);
  CHECK(document.mesh().positions.empty());
  return status.message();
}

/// Bit for bit, so that 0 and -0 differ.
inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Numbers of all sizes that need every one of 17 digits, from a fixed sequence.
inline std::vector<double> awkward_numbers(std::size_t count) {
  std::vector<double> numbers;
  std::uint64_t state = 0x9E3779B97F4A7C15u;
  while (numbers.size() < count) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    const double fraction = static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
    numbers.push_back(numbers.size() % 7 == 0 ? fraction * 1e-30 : fraction * 100.0);
  }
  return numbers;
}

/// The numbers as a binary file has them.
template <class T>
std::string binary(std::initializer_list<T> values, bool big_endian = false) {
  Bytes bytes;
  for (const T value : values) store(bytes, value, big_endian);
  return string_of(bytes);
}

constexpr FileFormat all_formats[] = {FileFormat::obj, FileFormat::ply, FileFormat::off, FileFormat::stl,
                                      FileFormat::xyz};

/// A file for the tests that run over every kind: it has every construct the format knows.
struct Sample {
  const char* name;
  FileFormat format;
  std::string file;
};
std::vector<Sample> samples();

}  // namespace pliant::io::test
