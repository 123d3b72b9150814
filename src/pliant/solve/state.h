// A saved deformation: named tables of numbers, so that every method is saved, bound and restored
// by the same code.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pliant {

/// A table of numbers: `data.size() / columns` rows, row after row; columns = 0 means one scalar.
struct StateTable {
  /// As in docs/state-and-report.md: "weights/mu" is a field of an object, "edges[]/i" one of each object in a list,
  /// "handles[]/targets[]" a list in each of them, and "handles[]" how many rows of it each has.
  std::string name;
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
