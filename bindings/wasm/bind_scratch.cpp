// What both modules share: the Scratch, the RawStatus, and how a call ends when memory does.
#include <new>

#include <emscripten/bind.h>
#include <emscripten/emscripten.h>

#include "pliant/io/memory.h"
#include "scratch.h"
#include "status_value.h"

// Thrown past the call under way, as a trap is; bindings/js/boundary/core.ts knows it by its message.
EM_JS(void, pliant_out_of_memory, (), { throw new WebAssembly.RuntimeError("out of memory"); });

namespace pliant::bindings {

namespace {

template <class T>
emscripten::val resized(std::vector<T>& slot, std::uint32_t length) {
  if (length > slot.capacity()) {
    slot = {};
    if (!io::memory_suffices(std::uint64_t{length} * sizeof(T))) return view_of(slot);
  }
  slot.resize(length);
  return view_of(slot);
}

}  // namespace

emscripten::val Scratch::doubles(std::uint32_t length) { return resized(doubles_, length); }

emscripten::val Scratch::integers(std::uint32_t length) { return resized(integers_, length); }

emscripten::val Scratch::bytes(std::uint32_t length) { return resized(bytes_, length); }

EMSCRIPTEN_BINDINGS(pliant_scratch) {
  using emscripten::select_overload;
  using emscripten::val;

  std::set_new_handler(pliant_out_of_memory);

  emscripten::value_object<StatusValue>("RawStatus")
      .field("code", &StatusValue::code)
      .field("message", &StatusValue::message);

  emscripten::class_<Scratch>("Scratch")
      .constructor<>()
      .function("doubles", select_overload<val(std::uint32_t)>(&Scratch::doubles))
      .function("integers", select_overload<val(std::uint32_t)>(&Scratch::integers))
      .function("bytes", select_overload<val(std::uint32_t)>(&Scratch::bytes));
}

}  // namespace pliant::bindings
