#include "pliant/io/ply_record.h"

#include <optional>

#include "pliant/core/message.h"
#include "pliant/io/bytes.h"
#include "pliant/io/lines.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

double load_number(const char* at, PlyType type, bool big_endian) {
  switch (type) {
    case PlyType::int8:
      return load<std::int8_t>(at, big_endian);
    case PlyType::uint8:
      return load<std::uint8_t>(at, big_endian);
    case PlyType::int16:
      return load<std::int16_t>(at, big_endian);
    case PlyType::uint16:
      return load<std::uint16_t>(at, big_endian);
    case PlyType::int32:
      return load<std::int32_t>(at, big_endian);
    case PlyType::uint32:
      return load<std::uint32_t>(at, big_endian);
    case PlyType::float32:
      return static_cast<double>(load<float>(at, big_endian));
    case PlyType::float64:
      return load<double>(at, big_endian);
  }
  return 0.0;
}

bool has_values(const PlyProperty& property) {
  return property.role != PlyRole::keep && property.role != PlyRole::drop;
}

std::string wrong_number(const PlyProperty& property, std::string_view word) {
  if (word.empty()) {
    return message({"the line ends before ", quoted(property.name)});
  }
  return message({property.name, " is ", quoted(word), "; expected a finite decimal number"});
}

/// Takes `count` words of a property from the line; reads them if the property has a role.
std::string take_words(const PlyProperty& property, std::uint64_t count, std::string_view line, std::size_t& at,
                       PlyRecord& record) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view word = next_word(line, at);
    if (word.empty()) {
      return wrong_number(property, word);
    }
    if (!has_values(property)) {
      continue;
    }
    const std::optional<double> value = read_number(word);
    const auto within = [role = property.role](PlyRole a, PlyRole b) { return role >= a && role <= b; };
    // No reason to refuse a file.
    const bool dispensable = within(PlyRole::red, PlyRole::blue) || within(PlyRole::nx, PlyRole::nz);
    if (!value && !dispensable) {
      return wrong_number(property, word);
    }
    record.values.push_back(value.value_or(0.0));
  }
  return {};
}

}  // namespace

std::size_t ply_record_size(const PlyElement& element, bool big_endian, std::string_view input, std::string& error) {
  std::uint64_t size = 0;  // 64 bits: a list may claim more than WASM can address
  for (const PlyProperty& property : element.properties) {
    std::uint64_t count = 1;
    if (property.is_list) {
      const std::size_t count_size = ply_size(property.count_type);
      if (size + count_size > input.size()) {
        return 0;
      }
      const double value = load_number(&input[static_cast<std::size_t>(size)], property.count_type, big_endian);
      if (value < 0) {
        error = message({"list ", quoted(property.name), " has a negative count"});
        return 0;
      }
      count = static_cast<std::uint64_t>(value);
      size += count_size;
    }
    size += count * ply_size(property.type);
    if (size > input.size()) {
      return 0;
    }
  }
  return static_cast<std::size_t>(size);
}

void lay_out_binary_record(const PlyElement& element, bool big_endian, std::string_view input, PlyRecord& record) {
  record.fields.clear();
  std::size_t at = 0;
  std::size_t first = 0;
  for (const PlyProperty& property : element.properties) {
    const std::size_t begin = at;
    std::size_t count = 1;
    if (property.is_list) {
      count = static_cast<std::size_t>(load_number(&input[at], property.count_type, big_endian));
      at += ply_size(property.count_type);
    }
    at += count * ply_size(property.type);
    const std::size_t numbers = has_values(property) ? count : 0;
    record.fields.push_back({begin, at, first, numbers});
    first += numbers;
  }
  record.values.resize(first);
}

void load_binary_record(const PlyElement& element, bool big_endian, std::string_view input, PlyRecord& record) {
  for (std::size_t p = 0; p < record.fields.size(); ++p) {
    const auto [begin, end, first, count] = record.fields[p];
    const PlyType type = element.properties[p].type;
    const std::size_t size = ply_size(type);
    const char* number = input.data() + end - count * size;
    for (std::size_t i = 0; i < count; ++i, number += size) {
      record.values[first + i] = load_number(number, type, big_endian);
    }
  }
}

std::string read_text_record(const PlyElement& element, std::string_view line, PlyRecord& record) {
  record.fields.clear();
  record.values.clear();
  std::size_t at = 0;
  for (const PlyProperty& property : element.properties) {
    while (at < line.size() && is_blank(line[at])) {
      ++at;
    }
    const std::size_t begin = at;
    const std::size_t first = record.values.size();
    std::uint64_t count = 1;
    if (property.is_list) {
      const std::string_view word = next_word(line, at);
      const std::optional<std::uint64_t> length = read_count(word);
      if (!length) {
        return message(
            {"the count of list ", quoted(property.name), " is ", quoted(word), "; expected a whole number"});
      }
      count = *length;
    }
    std::string error = take_words(property, count, line, at, record);
    if (!error.empty()) {
      return error;
    }
    record.fields.push_back({begin, at, first, record.values.size() - first});
  }
  const std::string_view extra = next_word(line, at);
  if (extra.empty()) {
    return {};
  }
  return message(
      {"found ", quoted(extra), " behind the ", element.properties.size(), " properties of element ", element.name});
}

}  // namespace pliant::io
