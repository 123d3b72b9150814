// The methods by their names: the one list of them in C++.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "pliant/core/named_values.h"
#include "pliant/solve/deformer.h"

namespace pliant {

struct RegisteredMethod {
  const char* name;  ///< as in scripts: "arap"
  Result<std::unique_ptr<Deformer>> (*build)(std::shared_ptr<const Shape> shape, const NamedValues& options);
};

std::span<const RegisteredMethod> registered_methods();

/// Builds a method with the options that are given; the others are those of its struct.
/// Errors: invalid_option (also an unknown method or option), and what the method's `create` says.
Result<std::unique_ptr<Deformer>> build_deformer(std::string_view method, std::shared_ptr<const Shape> shape,
                                                 const NamedValues& options);

}  // namespace pliant
