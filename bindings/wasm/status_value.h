// A Status on its way to JavaScript: RawStatus of bindings/js/boundary/raw.ts, registered in
// bind_scratch.cpp.
#pragma once

#include <string>

#include "pliant/core/status.h"

namespace pliant::bindings {

/// The RawStatus value object { code, message }.
struct StatusValue {
  std::string code;
  std::string message;
};

inline StatusValue to_value(const Status& status) { return {error_code_name(status.code()), status.message()}; }

}  // namespace pliant::bindings
