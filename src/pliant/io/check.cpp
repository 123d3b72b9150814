#include "pliant/io/check.h"

#include <cmath>

#include "pliant/core/message.h"

namespace pliant::io {

Status check_finite(std::span<const double> values, const char* name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) {
      continue;
    }
    return {ErrorCode::invalid_shape, message({name, "[", i, "] is ", values[i], "; expected a finite number"})};
  }
  return {};
}

}  // namespace pliant::io
