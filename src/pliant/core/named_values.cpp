#include "pliant/core/named_values.h"

#include <algorithm>
#include <utility>

#include "pliant/core/message.h"

namespace pliant {

std::size_t NamedFields::find(std::string_view name) const {
  return std::find_if(given_->begin(), given_->end(), [&](const NamedValue& value) { return value.name == name; }) -
         given_->begin();
}

const NamedValue* NamedFields::take(std::string_view name) {
  const std::size_t at = find(name);
  if (at == given_->size()) return nullptr;
  taken_[at] = true;
  return &(*given_)[at];
}

const std::vector<double>* NamedFields::take_numbers(const char* name, std::size_t count) {
  const NamedValue* value = take(name);
  if (value == nullptr) return nullptr;
  if (value->word.empty() && (count == kAnyNumber || value->numbers.size() == count)) return &value->numbers;
  fail(name, count == 1 ? "a number" : "numbers, as many as there are");
  return nullptr;
}

void NamedFields::tell(const char* name, std::vector<double> numbers) {
  NamedValue& value = told_.emplace_back();
  value.name = name;
  value.numbers = std::move(numbers);
}

void NamedFields::fail(const std::string& name, const char* expected) {
  if (status_.ok()) status_ = {ErrorCode::invalid_option, message({name, " does not fit; expected ", expected})};
}

Status NamedFields::status() const {
  if (!status_.ok() || tells()) return status_;
  const std::size_t left = std::find(taken_.begin(), taken_.end(), false) - taken_.begin();
  if (left == taken_.size()) return {};
  return {ErrorCode::invalid_option, message({(*given_)[left].name, " is not known, or does not go with the others"})};
}

void NamedFields::operator()(const char* name, double& value) {
  if (tells()) return tell(name, {value});
  if (const auto* given = take_numbers(name, 1)) value = given->front();
}

void NamedFields::operator()(const char* name, bool& value) {
  double number = value;
  (*this)(name, number);
  value = number != 0.0;
}

void NamedFields::operator()(const char* name, Index& value) {
  double number = value;
  (*this)(name, number);
  value = static_cast<Index>(std::clamp(number, -2147483648.0, 2147483647.0));
}

void NamedFields::operator()(const char* name, std::uint64_t& value) {
  double number = static_cast<double>(value);
  (*this)(name, number);
  value = static_cast<std::uint64_t>(std::clamp(number, 0.0, 9007199254740991.0));
}

void NamedFields::operator()(const char* name, std::optional<double>& value) {
  std::vector<double> numbers;
  if (value) numbers = {*value};
  (*this)(name, numbers);
  value = numbers.empty() ? std::nullopt : std::optional(numbers.front());
}

void NamedFields::operator()(const char* name, std::vector<double>& values) {
  if (tells()) return tell(name, values);
  if (const auto* given = take_numbers(name, kAnyNumber)) values = *given;
}

void NamedFields::operator()(const char* name, std::vector<Index>& values) {
  std::vector<double> numbers(values.begin(), values.end());
  (*this)(name, numbers);
  if (!tells()) values.assign(numbers.begin(), numbers.end());
}

void NamedFields::operator()(const char* name, Eigen::Vector3d& value) {
  if (tells()) return tell(name, {value.x(), value.y(), value.z()});
  if (const auto* given = take_numbers(name, 3)) value = Eigen::Map<const Eigen::Vector3d>(given->data());
}

void NamedFields::exchange_lists(const char* name, std::vector<std::vector<double>>& lists) {
  const std::string sizes_name = std::string(name) + "/sizes";
  std::vector<double> sizes, all;
  for (const std::vector<double>& list : lists) {
    sizes.push_back(static_cast<double>(list.size()));
    all.insert(all.end(), list.begin(), list.end());
  }
  (*this)(name, all);
  (*this)(sizes_name.c_str(), sizes);
  if (tells()) return;
  lists.clear();
  auto next = all.begin();
  for (const double size : sizes) {
    if (!(size >= 0.0 && size <= static_cast<double>(all.end() - next))) {
      return fail(sizes_name, "how many numbers each has");
    }
    const auto first = std::exchange(next, next + static_cast<std::ptrdiff_t>(size));
    lists.emplace_back(first, next);
  }
}

void NamedFields::exchange_word(const char* name, int& value, std::initializer_list<const char*> words) {
  if (tells()) {
    tell(name, {});
    told_.back().word = words.begin()[value];
    return;
  }
  const NamedValue* given = take(name);
  if (given == nullptr) return;
  const auto found = std::find(words.begin(), words.end(), given->word);
  if (found == words.end()) return fail(name, words.begin()[0]);
  value = static_cast<int>(found - words.begin());
}

}  // namespace pliant
