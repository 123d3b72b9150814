// Values by name: how options and other arguments come from another language or a file, and go back.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/core/types.h"

namespace pliant {

/// A word, or numbers where that is empty; no numbers at all stand for "none".
struct NamedValue {
  std::string name;
  std::string word;
  std::vector<double> numbers;
};

/// What is not given is not in it.
using NamedValues = std::vector<NamedValue>;

/// One pass over the fields of a struct by their names, in either direction: takes those that are
/// given and leaves the others as they are, or tells all. A struct says in one place what its fields
/// are called:
///   void exchange(NamedFields& fields, ArapOptions& options) { fields("smoothness", options.smoothness); }
/// and `read` and `named` below do the rest.
class NamedFields {
 public:
  /// Takes what is given, which has to outlive the pass.
  explicit NamedFields(const NamedValues& given) : given_(&given), taken_(given.size(), false) {}
  /// Tells.
  NamedFields() = default;

  void operator()(const char* name, double& value);
  void operator()(const char* name, bool& value);
  void operator()(const char* name, Index& value);
  void operator()(const char* name, std::uint64_t& value);  ///< below 2^53
  void operator()(const char* name, std::optional<double>& value);
  void operator()(const char* name, std::vector<double>& values);
  void operator()(const char* name, std::vector<Index>& values);
  void operator()(const char* name, Eigen::Vector3d& value);
  template <int Rows>
  void operator()(const char* name, Eigen::Matrix<double, Rows, Eigen::Dynamic>& columns);
  /// Lists in a row, and how many numbers each has under `name`/sizes.
  template <class List>
  void operator()(const char* name, std::vector<List>& lists);
  /// The word at the position of an enum's value.
  template <class Enum>
  void operator()(const char* name, Enum& value, std::initializer_list<const char*> words);

  /// Whether values are taken and this one is given.
  bool gives(std::string_view name) const { return given_ != nullptr && find(name) < given_->size(); }
  bool tells() const { return given_ == nullptr; }

  /// The first error: a value of another kind, or one that no field has taken. Errors: invalid_option.
  Status status() const;
  NamedValues told() && { return std::move(told_); }

 private:
  static constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);
  std::size_t find(std::string_view name) const;
  const NamedValue* take(std::string_view name);
  /// Numbers that were given; null without. Another number of them than `count` is an error.
  const std::vector<double>* take_numbers(const char* name, std::size_t count);
  void tell(const char* name, std::vector<double> numbers);
  void exchange_word(const char* name, int& value, std::initializer_list<const char*> words);
  void exchange_lists(const char* name, std::vector<std::vector<double>>& lists);
  void fail(const std::string& name, const char* expected);

  const NamedValues* given_ = nullptr;
  std::vector<bool> taken_;
  NamedValues told_;
  Status status_;
};

template <int Rows>
void NamedFields::operator()(const char* name, Eigen::Matrix<double, Rows, Eigen::Dynamic>& columns) {
  std::vector<double> numbers(columns.data(), columns.data() + columns.size());
  (*this)(name, numbers);
  using Columns = Eigen::Matrix<double, Rows, Eigen::Dynamic>;
  columns = Eigen::Map<const Columns>(numbers.data(), Rows, static_cast<Index>(numbers.size()) / Rows);
}

template <class List>
void NamedFields::operator()(const char* name, std::vector<List>& lists) {
  std::vector<std::vector<double>> numbers;
  for (const List& list : lists) numbers.emplace_back(list.data(), list.data() + list.size());
  exchange_lists(name, numbers);
  if (tells()) return;
  lists.clear();
  for (const std::vector<double>& of_one : numbers) {
    if constexpr (requires { List::RowsAtCompileTime; }) {
      constexpr int kRows = List::RowsAtCompileTime;
      lists.emplace_back(Eigen::Map<const List>(of_one.data(), kRows, static_cast<Index>(of_one.size()) / kRows));
    } else {
      lists.emplace_back(of_one.begin(), of_one.end());
    }
  }
}

template <class Enum>
void NamedFields::operator()(const char* name, Enum& value, std::initializer_list<const char*> words) {
  int position = static_cast<int>(value);
  exchange_word(name, position, words);
  value = static_cast<Enum>(position);
}

/// Takes what is given into a struct that has an `exchange`. Errors: invalid_option; the struct may
/// then be half read.
template <class Struct>
Status read(const NamedValues& given, Struct& into) {
  NamedFields fields(given);
  exchange(fields, into);
  return fields.status();
}

/// All fields of a struct that has an `exchange`, by name.
template <class Struct>
NamedValues named(Struct values) {
  NamedFields fields;
  exchange(fields, values);
  return std::move(fields).told();
}

}  // namespace pliant
