#include "pliant/io/draft.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pliant/core/message.h"
#include "pliant/io/check.h"
#include "pliant/io/number_text.h"

namespace pliant::io {
namespace {

/// Unit normal of the triangle at `corners` (9 numbers); zero where it has no area.
std::array<double, 3> unit_normal(const double* corners) {
  std::array<double, 6> edges{};
  double size = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    edges[i] = corners[3 + i] - corners[i % 3];
    size = std::max(size, std::abs(edges[i]));
  }
  // Dividing by the largest component keeps the products below within range.
  if (size == 0.0 || !std::isfinite(size)) {
    return {};
  }
  for (double& edge : edges) {
    edge /= size;
  }
  const auto [ax, ay, az, bx, by, bz] = edges;
  const std::array<double, 3> cross{ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx};
  const double length = std::hypot(cross[0], cross[1], cross[2]);
  if (length == 0.0) {
    return {};
  }
  return {cross[0] / length, cross[1] / length, cross[2] / length};
}

Status check_numbers(std::span<const double> numbers, std::size_t expected, const char* name) {
  if (numbers.size() == expected) {
    return check_finite(numbers, name);
  }
  return {ErrorCode::invalid_shape, message({name, " has ", numbers.size(), " numbers; expected ", expected})};
}

}  // namespace

std::size_t Draft::longest_number() const {
  switch (style_) {
    case NumberStyle::text:
      return kLongestText;
    case NumberStyle::double_little:
    case NumberStyle::double_big:
      return sizeof(double);
    case NumberStyle::float_little:
      return sizeof(float);
  }
  return kLongestText;
}

void Draft::clear() { rewind({0, 0, 0, 0}); }

void Draft::rewind(const Mark& mark) {
  kept_.cut(mark.kept);
  places_.resize(mark.places);
  points_.resize(mark.points);
  normals_.resize(mark.normals);
}

void Draft::add(Kind kind, std::size_t source) {
  places_.push_back({static_cast<std::uint32_t>(kept_.size()), static_cast<std::uint32_t>(source), kind});
}

void Draft::coordinate(double value) {
  add(Kind::coordinate, points_.size());
  points_.push_back(value);
}

void Draft::coordinate(std::size_t source, double value) {
  add(Kind::coordinate, source);
  points_.resize(source / 3 * 3 + 3);
  points_[source] = value;
}

void Draft::facet_normal(int component) {
  add(Kind::facet_normal, points_.size() + static_cast<std::size_t>(component));
}

void Draft::normal(std::size_t source, double value, bool single) {
  normals_.resize(source / 3 * 3 + 3);
  normals_[source] = std::isfinite(value) ? value : 0.0;
  add(single && style_ != NumberStyle::text ? Kind::single_normal : Kind::normal, source);
}

std::uint8_t* Draft::write(double value, Kind kind, std::uint8_t* to) const {
  if (kind == Kind::single_normal) {
    return store(to, static_cast<float>(value), style_ == NumberStyle::double_big);
  }
  switch (style_) {
    case NumberStyle::text:
      return to + print_number(value, reinterpret_cast<char*>(to));
    case NumberStyle::double_little:
      return store(to, value, false);
    case NumberStyle::double_big:
      return store(to, value, true);
    case NumberStyle::float_little:
      break;
  }
  const auto rounded = static_cast<float>(value);
  return std::isfinite(rounded) ? store(to, rounded, false) : nullptr;
}

Status Draft::emit(std::span<const double> coordinates, std::span<const double> normals, Bytes& out) {
  Status checked = check_numbers(coordinates, points_.size(), "positions");
  if (!checked.ok()) {
    return checked;
  }
  checked = check_numbers(normals, normals_.size(), "normals");
  if (!checked.ok()) {
    return checked;
  }
  std::array<double, 3> normal{};
  std::uint8_t* const begin = written_.room(kept_.size() + places_.size() * longest_number() + kLongestNumber);
  std::uint8_t* to = begin;
  std::size_t done = 0;
  const auto keep_to = [&](std::size_t end) {
    to = std::copy(kept_.data() + done, kept_.data() + end, to);
    done = end;
  };
  for (const Place& place : places_) {
    keep_to(place.after);
    const std::size_t component = place.source % 3;
    if (place.kind == Kind::facet_normal && component == 0) {
      normal = unit_normal(&coordinates[place.source]);
    }
    const double value = place.kind == Kind::coordinate     ? coordinates[place.source]
                         : place.kind == Kind::facet_normal ? normal[component]
                                                            : normals[place.source];
    to = write(value, place.kind, to);
    if (to == nullptr) {
      return {ErrorCode::invalid_shape,
              message({"coordinate ", value, " does not fit the 32-bit numbers of binary STL"})};
    }
  }
  keep_to(kept_.size());
  out.insert(out.end(), begin, to);
  return {};
}

}  // namespace pliant::io
