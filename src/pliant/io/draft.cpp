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

void Draft::clear() { rewind({0, 0, 0}); }

void Draft::rewind(const Mark& mark) {
  kept_.resize(mark.kept);
  places_.resize(mark.places);
  points_.resize(mark.points);
}

void Draft::coordinate(double value) {
  places_.push_back({static_cast<std::uint32_t>(kept_.size()), static_cast<std::int32_t>(points_.size())});
  points_.push_back(value);
}

void Draft::facet_normal(int component) {
  const auto facet_start = static_cast<std::int32_t>(points_.size());
  places_.push_back({static_cast<std::uint32_t>(kept_.size()), ~(facet_start + component)});
}

Status Draft::append_value(double value, Bytes& out) const {
  switch (style_) {
    case NumberStyle::text:
      append_number(out, value);
      break;
    case NumberStyle::double_little:
      store(out, value, false);
      break;
    case NumberStyle::double_big:
      store(out, value, true);
      break;
    case NumberStyle::float_little: {
      const auto rounded = static_cast<float>(value);
      if (!std::isfinite(rounded)) {
        return {ErrorCode::invalid_shape,
                message({"coordinate ", value, " does not fit the 32-bit numbers of binary STL"})};
      }
      store(out, rounded, false);
      break;
    }
  }
  return {};
}

Status Draft::emit(std::span<const double> coordinates, Bytes& out) const {
  if (coordinates.size() != points_.size()) {
    return {ErrorCode::invalid_shape,
            message({"positions has ", coordinates.size(), " numbers; expected ", points_.size()})};
  }
  Status finite = check_finite(coordinates, "positions");
  if (!finite.ok()) {
    return finite;
  }
  std::size_t done = 0;
  std::array<double, 3> normal{};
  for (const Place& place : places_) {
    out.insert(out.end(), kept_.begin() + std::ptrdiff_t(done), kept_.begin() + place.after);
    done = place.after;
    double value = 0.0;
    if (place.source >= 0) {
      value = coordinates[std::size_t(place.source)];
    } else {
      // Facets start at multiples of 9 coordinates, so the component is what remains.
      const std::int32_t source = ~place.source;
      const auto component = static_cast<std::size_t>(source % 3);
      if (component == 0) {
        normal = unit_normal(&coordinates[static_cast<std::size_t>(source)]);
      }
      value = normal[component];
    }
    Status status = append_value(value, out);
    if (!status.ok()) {
      return status;
    }
  }
  out.insert(out.end(), kept_.begin() + std::ptrdiff_t(done), kept_.end());
  return {};
}

}  // namespace pliant::io
