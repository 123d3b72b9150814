#include "pliant/deformers/arap/options.h"

#include <cmath>

#include "pliant/core/message.h"

namespace pliant {

Status ArapOptions::validate() const {
  const auto invalid = [](const char* name, double value, const char* expected) {
    return Status(ErrorCode::invalid_option, message({name, " is ", value, "; expected ", expected}));
  };
  if (constraint_weight && !(std::isfinite(*constraint_weight) && *constraint_weight > 0.0)) {
    return invalid("constraintWeight", *constraint_weight, "a finite number above 0");
  }
  if (!(smoothness >= 0.0 && smoothness <= 1.0)) {
    return invalid("smoothness", smoothness, "a part of the size, 0 to 1");
  }
  return {};
}

void exchange(NamedFields& fields, ArapOptions& options) {
  fields("energy", options.energy, {"spokes", "spokes-and-rims"});
  fields("constraintWeight", options.constraint_weight);
  fields("smoothness", options.smoothness);
}

}  // namespace pliant
