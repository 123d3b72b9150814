// Messages put together from words and numbers in one call; the one way to build them.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace pliant {

/// A word or a number of a message.
class Word {
 public:
  Word(const char* text) : text_(text) {}
  Word(const std::string& text) : text_(text) {}
  Word(std::string_view text) : text_(text) {}
  Word(double number) : kind_(Kind::real), real_(number) {}
  Word(std::integral auto number) : kind_(Kind::whole), whole_(static_cast<std::int64_t>(number)) {}

  void append_to(std::string& out) const;

 private:
  enum class Kind { text, whole, real };
  Kind kind_ = Kind::text;
  std::string_view text_;
  std::int64_t whole_ = 0;
  double real_ = 0.0;
};

using Words = std::initializer_list<Word>;

/// Words and numbers one behind the other: whole numbers with every digit, others with six significant ones and spelled
/// as JavaScript does (1e-7, 2.5e+30, NaN, -Infinity). They refer to what they were made of: for use at once.
std::string message(Words words);

}  // namespace pliant
