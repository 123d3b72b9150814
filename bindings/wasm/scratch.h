// Staging memory for arrays on their way into a module: RawScratch of bindings/js/boundary/raw.ts.
// JavaScript asks for a view, fills it by `.set()` and passes the scratch to the call that reads
// it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <emscripten/val.h>

namespace pliant::bindings {

/// Three slots, one a type of number; each keeps its content until it is resized.
class Scratch {
 public:
  /// Resize a slot and return a view of it, valid until WASM memory next grows: fill it at once.
  /// Where memory does not suffice the view is empty, so that `.set()` throws a RangeError.
  emscripten::val doubles(std::uint32_t length);
  emscripten::val integers(std::uint32_t length);
  emscripten::val bytes(std::uint32_t length);

  const std::vector<double>& doubles() const { return doubles_; }
  const std::vector<std::int32_t>& integers() const { return integers_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  void set_doubles(std::vector<double> numbers) { doubles_ = std::move(numbers); }
  /// The bytes without a copy; the slot is then empty.
  std::vector<std::uint8_t> take_bytes() { return std::exchange(bytes_, {}); }

 private:
  std::vector<double> doubles_;
  std::vector<std::int32_t> integers_;
  std::vector<std::uint8_t> bytes_;
};

/// A view of an array (a vector, or a matrix column by column) that WASM memory holds, valid until
/// the owner's next call.
template <class Array>
emscripten::val view_of(const Array& array) {
  return emscripten::val(emscripten::typed_memory_view(static_cast<std::size_t>(array.size()), array.data()));
}

}  // namespace pliant::bindings
