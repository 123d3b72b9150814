// Bytes of a file, and the binary numbers in them.
#pragma once

#include <algorithm>
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
  std::memcpy(raw, at, sizeof(T));
  if (big_endian) {
    std::reverse(raw, raw + sizeof(T));
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// Puts the number at `to`, where sizeof(T) bytes are free; returns where it ends.
template <class T>
std::uint8_t* store(std::uint8_t* to, T value, bool big_endian) {
  std::memcpy(to, &value, sizeof(T));
  if (big_endian) {
    std::reverse(to, to + sizeof(T));
  }
  return to + sizeof(T);
}

template <class T>
void store(Bytes& out, T value, bool big_endian) {
  std::uint8_t raw[sizeof(T)];
  out.insert(out.end(), raw, store(raw, value, big_endian));
}

/// Memory that is filled from the front, again and again. A vector of bytes takes a call for each in the WASM.
class ByteBuffer {
 public:
  std::size_t size() const { return size_; }
  const std::uint8_t* data() const { return bytes_.data(); }

  /// Keeps the first `size` bytes.
  void cut(std::size_t size) { size_ = size; }
  /// Where the next `size` bytes go; `grow` takes those that were written.
  std::uint8_t* room(std::size_t size) {
    if (bytes_.size() - size_ < size) {
      bytes_.resize(2 * bytes_.size() + size);
    }
    return bytes_.data() + size_;
  }
  void grow(std::size_t size) { size_ += size; }

  void append(std::string_view bytes) {
    if (!bytes.empty()) {
      std::memcpy(room(bytes.size()), bytes.data(), bytes.size());
      size_ += bytes.size();
    }
  }

 private:
  Bytes bytes_;
  std::size_t size_ = 0;
};

}  // namespace pliant::io
