// Asking for memory before a vector takes it: without exceptions one that cannot grow ends the
// program, and in WASM the module with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace pliant::io {

/// Whether an array of this many bytes can be had now, and, if it is a large one, some more for
/// what follows.
inline bool memory_suffices(std::uint64_t bytes) {
  constexpr std::uint64_t slack = std::uint64_t{64} << 20;
  const std::uint64_t request = bytes < slack ? bytes : bytes + slack;
  if (request > SIZE_MAX / 2) {
    return false;
  }
  // volatile: the compiler may leave out an allocation nobody looks at, and call it a success.
  void* volatile memory = std::malloc(static_cast<std::size_t>(request) + 1);
  const bool suffices = memory != nullptr;
  std::free(memory);
  return suffices;
}

}  // namespace pliant::io
