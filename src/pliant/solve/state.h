// A saved deformation: named tables of numbers, so that every method is saved, bound and restored
// by the same code.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pliant {

/// A table of numbers: `data.size() / columns` rows, row after row; columns = 0 means one scalar.
struct StateTable {
  std::string name;  ///< as in docs/state-and-report.md; "handles/vertices" is a field of a list of objects
  int columns = 1;
  bool integral = false;
  std::vector<double> data;
};

struct State {
  std::vector<StateTable> tables;

  StateTable& add(std::string name, int columns, bool integral);
  /// nullptr when there is no such table.
  const StateTable* find(std::string_view name) const;
};

}  // namespace pliant
