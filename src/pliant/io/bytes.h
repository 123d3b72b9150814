// Bytes of a file, and the binary numbers in them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace pliant::io {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

inline std::string_view text_of(ByteView bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

inline void append(Bytes& out, std::string_view text) { out.insert(out.end(), text.begin(), text.end()); }

static_assert(std::endian::native == std::endian::little, "binary numbers are swapped from little");

/// The number at `at`; the caller has checked that sizeof(T) bytes are there.
template <class T>
T load(const char* at, bool big_endian) {
  char raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    raw[i] = at[big_endian ? sizeof(T) - 1 - i : i];
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

template <class T>
void store(Bytes& out, T value, bool big_endian) {
  std::uint8_t raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian) {
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) {
      std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    }
  }
  out.insert(out.end(), raw, raw + sizeof(T));
}

}  // namespace pliant::io
