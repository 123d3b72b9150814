// Lines, words and numbers of the text formats. Internal to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "pliant/io/scanner.h"

namespace pliant::io {

/// Where the line that begins at `at` ends, its ending (\n, \r\n or \r) included; npos when `text`
/// does not hold all of it. With `last` the end of the text ends the line.
std::size_t line_end(std::string_view text, std::size_t at, bool last);

bool is_blank(char c);

/// The next run of characters other than blanks from `at` on, moving `at` behind it; empty at the
/// end. A backslash before a line ending is a blank (OBJ continues lines so).
std::string_view next_word(std::string_view text, std::size_t& at);

/// The line up to its comment, if any.
inline std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

/// A word of a file fit for a message: at most 40 characters, unprintable ones replaced.
std::string quoted(std::string_view word);

/// What the text formats share: places are lines, and points are three words.
class TextScanner : public Scanner {
 public:
  std::string place() const final { return message({"line ", line_}); }

 protected:
  /// Reads three numbers of the line from `at` on and puts them into the draft with the bytes
  /// between `kept` and them; afterwards both stand behind the third.
  Status take_point(std::string_view line, std::size_t& kept, std::size_t& at, Draft& draft);

  /// Three or four numbers behind a point are a colour (the fourth, how opaque it is, is left out): fractions of 1, or
  /// of 255 where each is a whole number and one is above 1. Any other number of words, or other words, are none.
  static bool read_color(std::string_view words, double (&rgb)[3]);

  std::uint64_t line_ = 1;
  std::uint64_t vertices_ = 0;
};

/// A text format with one record a line.
class LineScanner : public TextScanner {
 public:
  Result<std::size_t> scan(std::string_view input, bool last, Draft& draft) final;

 protected:
  /// One line with its ending, without a byte order mark. All of it goes into the draft, or is
  /// dropped on purpose. Errors: parse_error.
  virtual Status scan_line(std::string_view line, Draft& draft) = 0;
  /// Whether the next line continues this one.
  virtual bool continues(std::string_view /*line*/) const { return false; }

 private:
  std::size_t record_end(std::string_view text, std::size_t at, bool last, std::uint64_t& lines) const;

  bool at_start_ = true;
};

}  // namespace pliant::io
