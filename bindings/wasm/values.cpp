#include "values.h"

#include <cstdlib>
#include <utility>

#include "pliant/core/message.h"

namespace pliant::bindings {

NamedValues named_values(const std::string& names, const Scratch& scratch) {
  NamedValues values;
  auto next = scratch.doubles().begin();
  for (std::size_t from = 0; from < names.size();) {
    const std::size_t end = names.find('\n', from), middle = names.find_first_of("= ", from);
    NamedValue& value = values.emplace_back();
    value.name = names.substr(from, middle - from);
    if (names[middle] == '=') {
      value.word = names.substr(middle + 1, end - middle - 1);
    } else {
      const auto first = std::exchange(next, next + std::atoi(&names[middle + 1]));
      value.numbers.assign(first, next);
    }
    from = end + 1;
  }
  return values;
}

std::string stage(const NamedValues& values, Scratch& scratch) {
  std::string names;
  std::vector<double> numbers;
  for (const NamedValue& value : values) {
    names += value.word.empty() ? message({value.name, " ", value.numbers.size(), "\n"})
                                : message({value.name, "=", value.word, "\n"});
    numbers.insert(numbers.end(), value.numbers.begin(), value.numbers.end());
  }
  scratch.set_doubles(std::move(numbers));
  return names;
}

}  // namespace pliant::bindings
