#include "pliant/core/status.h"

namespace pliant {

const char* error_code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::ok:
      return "ok";
    case ErrorCode::invalid_shape:
      return "invalid-shape";
    case ErrorCode::invalid_option:
      return "invalid-option";
    case ErrorCode::invalid_handle:
      return "invalid-handle";
    case ErrorCode::parse_error:
      return "parse-error";
    case ErrorCode::not_solvable:
      return "not-solvable";
    case ErrorCode::too_large:
      return "too-large";
  }
  return "ok";
}

}  // namespace pliant
