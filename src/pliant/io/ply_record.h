// One record of a PLY file. Internal to io.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/io/ply_header.h"

namespace pliant::io {

/// Where the properties of a record stand, and the numbers of those that have a role.
struct PlyRecord {
  struct Field {
    std::size_t begin, end;    ///< its bytes in the record; a list's count included
    std::size_t first, count;  ///< its numbers in `values`; none for PlyRole::keep and drop
  };
  std::vector<Field> fields;
  std::vector<double> values;
};

/// The bytes of the binary record at the front of `input`; 0 when it does not hold all of them.
/// `error` is set when a list has a negative count.
std::size_t ply_record_size(const PlyElement& element, bool big_endian, std::string_view input, std::string& error);

/// Finds the fields of the binary record at the front of `input`, which holds all of it; the same ones for every record
/// of an element without lists.
void lay_out_binary_record(const PlyElement& element, bool big_endian, std::string_view input, PlyRecord& record);
/// Reads the numbers of such a record.
void load_binary_record(const PlyElement& element, bool big_endian, std::string_view input, PlyRecord& record);

/// Reads one line. Returns what is wrong with it, if anything.
std::string read_text_record(const PlyElement& element, std::string_view line, PlyRecord& record);

}  // namespace pliant::io
