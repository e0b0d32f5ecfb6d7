#include "interpreter/values/value.hpp"

#include <catch2/catch.hpp>

#include <stdexcept>

#include "interpreter/values/big_integer.hpp"
#include "interpreter/values/dict.hpp"

using namespace comma::interpreter;

TEST_CASE("A value knows its kind", "[value]") {
  CHECK(Value().is_none());
  CHECK(Value(true).is_bool());
  CHECK_FALSE(Value(true).is_integer());
  CHECK(Value(3).is_integer());
  CHECK(Value(3).is_number());
  CHECK(Value(3.0).is_real());
  CHECK_FALSE(Value(true).is_number());
  CHECK(Value("a").is_text());
  CHECK(Value::tuple({}).is_tuple());
  CHECK(Value::list({}).is_sequence());
  CHECK(Value::unknown().is_unknown());
  CHECK(Value(std::complex<double>(1, 2)).is_complex());
  CHECK(Value::dict({{"a", Value(1)}}).is_dict());
}

TEST_CASE("An int reads as a float and as a complex, a float not as an int", "[value]") {
  CHECK(Value(3).as_real() == 3.0);
  CHECK(Value(3).as_complex() == std::complex<double>(3.0, 0.0));
  CHECK_THROWS_AS(Value(3.5).as_integer(), std::logic_error);
  CHECK_THROWS_AS(Value("x").as_real(), std::logic_error);
  CHECK_THROWS_AS(Value(1).items(), std::logic_error);
}

TEST_CASE("An int beyond 64 bits is an int with another representation", "[value]") {
  const Value big = Value::integer(BigInteger(1).shifted_left(64));
  CHECK(big.is_big_integer());
  CHECK_FALSE(big.is_integer());
  CHECK(big.type_name() == "int");
  CHECK(big.repr() == "18446744073709551616");
  CHECK(Value::integer(BigInteger(5)).is_integer());
}

TEST_CASE("A list copied is the same list", "[value]") {
  const Value a = Value::list({Value(1)});
  const Value b = a;
  b.as_list().push_back(Value(2));
  CHECK(a.items().size() == 2);
}

TEST_CASE("Type names are Python's, and a concept's own", "[value]") {
  CHECK(Value().type_name() == "NoneType");
  CHECK(Value(1.0).type_name() == "float");
  CHECK(Value("").type_name() == "str");
  auto handle = std::make_shared<Concept>();
  handle->name = "MA";
  handle->type = "maillage_sdaster";
  CHECK(Value(handle).type_name() == "maillage_sdaster");
  CHECK(Value(handle).repr() == "MA");
  auto factor = std::make_shared<Dict>();
  factor->set("TOUT", "OUI");
  factor->factor = std::make_shared<const FactorPlaces>();
  CHECK(Value(factor).repr() == "_F(TOUT='OUI')");
  CHECK(Value(factor).type_name() == "_F");
}

TEST_CASE("A tower of lists is released without a tower of calls", "[value]") {
  Value tower = Value::list({});
  for (int i = 0; i < 1'000'000; ++i) tower = Value::list({tower});
  tower = Value();
  Value dicts = Value::dict({});
  for (int i = 0; i < 200'000; ++i) dicts = Value::dict({{"a", dicts}});
  CHECK(tower.is_none());
}

TEST_CASE("A list that holds itself is shown with dots", "[value]") {
  const Value list = Value::list({Value(1)});
  list.as_list().push_back(list);
  CHECK(list.repr() == "[1, [...]]");
  list.as_list().clear();
}
