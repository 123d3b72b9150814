#include "pliant/io/format.h"

#include <utility>

#include "pliant/core/message.h"

namespace pliant::io {

Result<FileFormat> format_from_name(std::string_view name) {
  constexpr std::pair<std::string_view, FileFormat> formats[] = {{"obj", FileFormat::obj},
                                                                 {"ply", FileFormat::ply},
                                                                 {"off", FileFormat::off},
                                                                 {"stl", FileFormat::stl},
                                                                 {"xyz", FileFormat::xyz}};
  for (const auto& [known, format] : formats) {
    if (name == known) {
      return format;
    }
  }
  return Status(ErrorCode::invalid_option,
                message({"format is \"", name.substr(0, 40), "\"; expected obj, ply, off, stl or xyz"}));
}

}  // namespace pliant::io
