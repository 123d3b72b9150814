// What both modules share: the Scratch and the RawStatus.
#include <emscripten/bind.h>

#include "scratch.h"
#include "status_value.h"

namespace pliant::bindings {

emscripten::val Scratch::doubles(std::uint32_t length) {
  doubles_.resize(length);
  return view_of(doubles_);
}

emscripten::val Scratch::integers(std::uint32_t length) {
  integers_.resize(length);
  return view_of(integers_);
}

emscripten::val Scratch::bytes(std::uint32_t length) {
  bytes_.resize(length);
  return view_of(bytes_);
}

EMSCRIPTEN_BINDINGS(pliant_scratch) {
  using emscripten::select_overload;
  using emscripten::val;

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
