#include "interpreter/values/dict.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "interpreter/values/big_integer.hpp"
#include "interpreter/values/exception.hpp"

using namespace comma::interpreter;

TEST_CASE("Keys keep the order of insertion through replacement and removal", "[dict]") {
  Dict dict;
  for (int i = 0; i < 100; ++i) dict.set(Value(i), Value(i));
  for (int i = 0; i < 100; i += 2) CHECK(dict.erase(Value(i)));
  dict.set(Value(1), Value("one"));
  dict.set(Value(0), Value("zero"));
  CHECK(dict.size() == 51);
  const auto keys = dict.keys();
  CHECK(keys.front().as_integer() == 1);
  CHECK(keys.back().as_integer() == 0);
  CHECK(dict.find(Value(1))->as_text() == "one");
  CHECK(dict.find(Value(2)) == nullptr);
}

TEST_CASE("Equal numbers are one key, whatever their type", "[dict]") {
  Dict dict;
  dict.set(Value(1), Value("a"));
  CHECK(dict.find(Value(1.0)) != nullptr);
  CHECK(dict.find(Value(true)) != nullptr);
  CHECK(dict.find(Value(std::complex<double>(1.0, 0.0))) != nullptr);
  CHECK(dict.find(Value("1")) == nullptr);
  const Value big = Value::integer(BigInteger(1).shifted_left(80));
  dict.set(big, Value());
  CHECK(dict.find(Value(std::ldexp(1.0, 80))) != nullptr);
}

TEST_CASE("What can change is no key", "[dict]") {
  Dict dict;
  CHECK_THROWS_AS(dict.set(Value::list({}), Value()), RaisedError);
  CHECK_THROWS_AS(dict.set(Value::tuple({Value::list({})}), Value()), RaisedError);
  CHECK_NOTHROW(dict.set(Value::tuple({Value(1)}), Value()));
}
