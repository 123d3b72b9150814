#include "pliant/core/message.h"

#include <cstdint>
#include <limits>
#include <string>

#include <doctest/doctest.h>

namespace pliant {
namespace {

std::string spelled(double number) { return message({number}); }

TEST_CASE("a message is its words and numbers one behind the other") {
  const std::string name = "handles";
  CHECK(message({name, "[", std::size_t{3}, "] is ", -1, "; expected ", 0.5, std::string_view("!")}) ==
        "handles[3] is -1; expected 0.5!");
  CHECK(message({}) == "");
  CHECK(message({std::uint32_t{4294967295u}, " ", std::numeric_limits<std::int64_t>::min()}) ==
        "4294967295 -9223372036854775808");
}

TEST_CASE("whole numbers keep every digit") {
  CHECK(spelled(0.0) == "0");
  CHECK(spelled(-0.0) == "0");
  CHECK(spelled(1234567.0) == "1234567");
  CHECK(spelled(-999999999999999.0) == "-999999999999999");
}

TEST_CASE("other numbers have six significant digits, spelled as in JavaScript") {
  CHECK(spelled(1.5) == "1.5");
  CHECK(spelled(-0.1) == "-0.1");
  CHECK(spelled(1.0 / 3.0) == "0.333333");
  CHECK(spelled(200.0 / 3.0) == "66.6667");
  CHECK(spelled(0.99999999) == "1");
  CHECK(spelled(100.05) == "100.05");
  CHECK(spelled(123456789.5) == "123456790");
  CHECK(spelled(0.000001) == "0.000001");
  CHECK(spelled(0.0000012345678) == "0.00000123457");
  CHECK(spelled(1e-7) == "1e-7");
  CHECK(spelled(9.9999999e-8) == "1e-7");
  CHECK(spelled(2.5e30) == "2.5e+30");
  CHECK(spelled(1e15) == "1e+15");
  CHECK(spelled(std::numeric_limits<double>::max()) == "1.79769e+308");
  CHECK(spelled(std::numeric_limits<double>::denorm_min()) == "4.94066e-324");
}

TEST_CASE("what is no number is named") {
  CHECK(spelled(std::numeric_limits<double>::quiet_NaN()) == "NaN");
  CHECK(spelled(std::numeric_limits<double>::infinity()) == "Infinity");
  CHECK(spelled(-std::numeric_limits<double>::infinity()) == "-Infinity");
}

}  // namespace
}  // namespace pliant
