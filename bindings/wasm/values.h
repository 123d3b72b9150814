// Named values on their way from and to JavaScript: RawNames of bindings/js/boundary/raw.ts.
#pragma once

#include <string>

#include "pliant/core/named_values.h"
#include "scratch.h"
#include "status_value.h"

namespace pliant::bindings {

/// What JavaScript staged. `names` has a line for each value, "name=word" or "name count": so many
/// of the scratch's doubles, one value after the other.
NamedValues named_values(const std::string& names, const Scratch& scratch);

/// The same back.
std::string stage(const NamedValues& values, Scratch& scratch);

/// What comes of using a struct that has an `exchange`.
template <class Struct, class Use>
StatusValue with_fields(const std::string& names, const Scratch& scratch, const Use& use) {
  Struct fields;
  const Status status = read(named_values(names, scratch), fields);
  return to_value(status.ok() ? use(fields) : status);
}

}  // namespace pliant::bindings
