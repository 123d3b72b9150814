// RawState of bindings/js/boundary/raw.ts: a State read and filled table by table.
#pragma once

#include <string>

#include "pliant/solve/state.h"
#include "scratch.h"

namespace pliant::bindings {

/// Indices of tables come from bindings/js, which stays below size().
class BoundState {
 public:
  int size() const { return static_cast<int>(state.tables.size()); }
  std::string name(int table) const { return state.tables[table].name; }
  int columns(int table) const { return state.tables[table].columns; }
  bool integral(int table) const { return state.tables[table].integral; }
  emscripten::val data(int table) const { return view_of(state.tables[table].data); }
  /// Takes scratch.doubles as the table's data.
  void add(const std::string& name, int columns, bool integral, const Scratch& scratch);

  State state;
};

}  // namespace pliant::bindings
