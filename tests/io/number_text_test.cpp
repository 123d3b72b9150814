#include "pliant/io/number_text.h"

#include <cstring>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "io/io_support.h"

namespace pliant::io {
namespace {

std::string written(double value) {
  Bytes out;
  append_number(out, value);
  return std::string(text_of(out));
}

TEST_CASE("a number is written with 17 significant digits, on every platform alike") {
  CHECK(written(0.0) == "0");
  CHECK(written(-0.0) == "-0");
  CHECK(written(1.0) == "1");
  CHECK(written(0.1) == "0.10000000000000001");
  CHECK(written(1.0 / 3.0) == "0.33333333333333331");
  CHECK(written(1e22) == "1e+22");
  CHECK(written(123456789012345678.0) == "1.2345678901234568e+17");
  CHECK(written(0.00001) == "1.0000000000000001e-05");
  CHECK(written(std::numeric_limits<double>::max()) == "1.7976931348623157e+308");
  CHECK(written(std::numeric_limits<double>::denorm_min()) == "4.9406564584124654e-324");
}

TEST_CASE("every number read back is the number written, bit for bit") {
  std::vector<double> numbers = test::awkward_numbers(2000);
  std::uint64_t bits = 1;
  for (int i = 0; i < 5000; ++i) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (value - value == 0.0) numbers.push_back(value);
  }
  for (const double value : numbers) {
    const std::optional<double> back = read_number(written(value));
    REQUIRE(back.has_value());
    CHECK(std::memcmp(&*back, &value, sizeof value) == 0);
  }
}

TEST_CASE("a number is the double nearest to its digits, ties to even") {
  CHECK(read_number("9007199254740993") == 9007199254740992.0);
  CHECK(read_number("9007199254740995") == 9007199254740996.0);
  CHECK(read_number("9007199254740993.0000000000000000000001") == 9007199254740994.0);
  CHECK(read_number("1.00000000000000011102230246251565404") == 1.0);
  CHECK(read_number("1.00000000000000011102230246251565405") == 1.0000000000000002);
  CHECK(read_number("0.1") == 0.1);
  CHECK(read_number("3e-27") == 3e-27);
  CHECK(read_number("3e27") == 3e27);
  CHECK(read_number("12345678901234567e-28") == 12345678901234567e-28);
  CHECK(read_number("2.2250738585072011e-308") == 2.2250738585072011e-308);
  CHECK(read_number("1e-400") == 0.0);
  CHECK(read_number("0e999") == 0.0);
  CHECK(read_number("0." + std::string(400, '0') + "1e401") == 1.0);
  CHECK(read_number("1" + std::string(400, '0') + "e-400") == 1.0);
}

TEST_CASE("the spellings files use") {
  CHECK(read_number("+1.5") == 1.5);
  CHECK(read_number("-.5") == -0.5);
  CHECK(read_number("5.") == 5.0);
  CHECK(read_number("1E+2") == 100.0);
  CHECK(read_number("00012") == 12.0);
  for (const char* text : {"",
                           "+",
                           "-",
                           ".",
                           "e5",
                           "1e",
                           "1e+",
                           "1.2.3",
                           "1,5",
                           "0x10",
                           "nan",
                           "inf",
                           "-Infinity",
                           "1e999",
                           "1"
                           "e309",
                           " 1",
                           "1 ",
                           "--1",
                           "1f",
                           "1d5"}) {
    CAPTURE(text);
    CHECK_FALSE(read_number(text).has_value());
  }
}

TEST_CASE("counts are whole numbers without a sign") {
  CHECK(read_count("0") == 0);
  CHECK(read_count("999999999999999999") == 999999999999999999u);
  for (const char* text : {"", "-1", "+1", "1.0", "1e3", "1000000000000000000", "x"}) {
    CAPTURE(text);
    CHECK_FALSE(read_count(text).has_value());
  }
}

}  // namespace
}  // namespace pliant::io
