#include "interpreter/values/repr.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

using namespace comma::interpreter;

TEST_CASE("The text of a float reads back as the same float", "[repr]") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (value != value) continue;
    REQUIRE(std::strtod(repr_of(value).c_str(), nullptr) == value);
  }
}

TEST_CASE("A float switches to exponents where Python's does", "[repr]") {
  CHECK(repr_of(1e15) == "1000000000000000.0");
  CHECK(repr_of(1e16) == "1e+16");
  CHECK(repr_of(0.0001) == "0.0001");
  CHECK(repr_of(0.00001) == "1e-05");
  CHECK(repr_of(-0.0) == "-0.0");
  CHECK(repr_of(123456.789) == "123456.789");
  CHECK(repr_of(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(repr_of(5e-324) == "5e-324");
}

TEST_CASE("A text chooses the quotes that need no escape", "[repr]") {
  CHECK(repr_of(std::string_view("it's")) == "\"it's\"");
  CHECK(repr_of(std::string_view("a\n'\"")) == "'a\\n\\'\"'");
}
