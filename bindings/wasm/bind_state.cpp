// Saved deformations: RawState.
#include <emscripten/bind.h>

#include "bound_state.h"

namespace pliant::bindings {

void BoundState::add(const std::string& name, int columns, bool integral, const Scratch& scratch) {
  state.add(name, columns, integral).data = scratch.doubles();
}

EMSCRIPTEN_BINDINGS(pliant_state) {
  emscripten::class_<BoundState>("State")
      .constructor<>()
      .function("size", &BoundState::size)
      .function("name", &BoundState::name)
      .function("columns", &BoundState::columns)
      .function("integral", &BoundState::integral)
      .function("data", &BoundState::data)
      .function("add", &BoundState::add);
}

}  // namespace pliant::bindings
