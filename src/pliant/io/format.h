// The file formats of the io layer, and the names they go by.
#pragma once

#include <string_view>

#include "pliant/core/status.h"

namespace pliant::io {

enum class FileFormat { obj, ply, off, stl, xyz };

/// "obj" | "ply" | "off" | "stl" | "xyz", in lower case. Errors: invalid_option.
Result<FileFormat> format_from_name(std::string_view name);

}  // namespace pliant::io
