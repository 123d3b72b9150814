// The check all numbers from callers pass. Internal to io.
#pragma once

#include <span>

#include "pliant/core/status.h"

namespace pliant::io {

/// Errors: invalid_shape, as in "positions[4] is NaN; expected a finite number".
Status check_finite(std::span<const double> values, const char* name);

}  // namespace pliant::io
