#include "pliant/solve/state.h"

#include <utility>

namespace pliant {

StateTable& State::add(std::string name, int columns, bool integral) {
  tables.push_back({std::move(name), columns, integral, {}});
  return tables.back();
}

const StateTable* State::find(std::string_view name) const {
  for (const StateTable& table : tables) {
    if (table.name == name) return &table;
  }
  return nullptr;
}

}  // namespace pliant
