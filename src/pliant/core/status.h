// How errors travel: by value. The library is built without exceptions (they cost WASM 5-7 kB and
// reach JavaScript as an opaque number), so a call that can fail returns a Status or a Result<T>.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace pliant {

/// The stable error codes of docs/errors.md; `error_code_name` gives their public spelling.
enum class ErrorCode {
  ok,
  invalid_shape,
  invalid_option,
  invalid_handle,
  parse_error,
  not_solvable,
  too_large,
};

const char* error_code_name(ErrorCode code);

/// Success, or an error code with a message that names the argument, the value and what was
/// expected.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(ErrorCode code, std::string message) : code_(code), message_(std::move(message)) {}

  bool ok() const { return code_ == ErrorCode::ok; }
  ErrorCode code() const { return code_; }
  const std::string& message() const { return message_; }

 private:
  ErrorCode code_ = ErrorCode::ok;
  std::string message_;
};

/// A value, or the Status that says why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status error) : status_(std::move(error)) { assert(!status_.ok()); }

  bool ok() const { return status_.ok(); }
  const Status& status() const { return status_; }

  T& value() {
    assert(value_);
    return *value_;
  }
  const T& value() const {
    assert(value_);
    return *value_;
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  Status status_;
  std::optional<T> value_;
};

}  // namespace pliant
