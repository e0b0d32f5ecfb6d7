#include "commands/verdict.hpp"

#include <catch2/catch.hpp>

using namespace comma::commands;
using comma::interpreter::Keyword;
using comma::interpreter::Keywords;
using comma::interpreter::Value;

namespace {

Keyword keyword(const std::string& name, Value value, bool given = true) {
  Keyword made;
  made.name = name;
  made.value = std::move(value);
  made.given = given;
  return made;
}

// A TEST_RESU occurrence with the catalogue's defaults.
Keywords test_with(std::vector<Keyword> given) {
  Keywords test;
  test.items = std::move(given);
  const auto add_default = [&](const std::string& name, Value value) {
    if (!test.has(name)) test.items.push_back(keyword(name, std::move(value), false));
  };
  add_default("CRITERE", Value::tuple({Value("RELATIF")}));
  add_default("TOLE_MACHINE", Value::tuple({Value(1e-6)}));
  add_default("PRECISION", Value::tuple({Value(1e-3)}));
  return test;
}

Keyword reals(const std::string& name, double value) { return keyword(name, Value::tuple({Value(value)})); }

}  // namespace

TEST_CASE("A VALE_CALC is judged to 1e-6 and a VALE_REFE to 1e-3 unless the file says otherwise") {
  const auto verdicts =
      judge(test_with({reals("VALE_CALC", 2.0), reals("VALE_REFE", 2.001)}), "TEST_RESU", "x", 2.000001);
  REQUIRE(verdicts.size() == 2);
  CHECK(verdicts[0].kind == "VALE_CALC");
  CHECK(verdicts[0].passed);
  CHECK(verdicts[0].tolerance == 1e-6);
  CHECK(verdicts[0].error == Approx(5e-7).epsilon(1e-6));
  CHECK(verdicts[1].passed);
  CHECK(verdicts[1].tolerance == 1e-3);
}

TEST_CASE("A value just outside its tolerance fails") {
  CHECK_FALSE(judge(test_with({reals("VALE_CALC", 1.0)}), "TEST_RESU", "x", 1.0 + 1.1e-6)[0].passed);
  CHECK(judge(test_with({reals("VALE_CALC", 1.0)}), "TEST_RESU", "x", 1.0 + 0.9e-6)[0].passed);
}

TEST_CASE("A relative test of zero is absolute unless an order of magnitude is given") {
  const auto plain = judge(test_with({reals("VALE_CALC", 0.0)}), "TEST_RESU", "x", 5e-7)[0];
  CHECK_FALSE(plain.relative);
  CHECK(plain.passed);
  const auto scaled =
      judge(test_with({reals("VALE_CALC", 0.0), keyword("ORDRE_GRANDEUR", Value(1e10))}), "TEST_RESU", "x", 100.0)[0];
  CHECK(scaled.relative);
  CHECK(scaled.error == Approx(1e-8));
  CHECK(scaled.passed);
}

TEST_CASE("VALE_ABS drops the signs of references too, of a function's value alone") {
  const Keyword magnitudes = keyword("VALE_ABS", Value("OUI"));
  const auto test = test_with({reals("VALE_CALC", -2.0), reals("VALE_REFE", 2.0), magnitudes});
  for (const auto& verdict : judge(test, "TEST_TABLE", "x", -2.0)) CHECK(verdict.passed);
  CHECK_FALSE(judge_function(test, "x", -2.0)[0].passed);
  CHECK(judge_function(test, "x", -2.0)[1].passed);
  const auto integers = test_with({keyword("VALE_CALC_I", Value::tuple({Value(-3), Value(7)})), magnitudes});
  CHECK(judge(integers, "TEST_TABLE", "x", std::int64_t{-3})[0].passed);
}

TEST_CASE("CRITERE ABSOLU compares differences") {
  const auto verdict = judge(test_with({reals("VALE_CALC", 1e6), keyword("CRITERE", Value::tuple({Value("ABSOLU")}))}),
                             "TEST_RESU", "x", 1e6 + 0.1)[0];
  CHECK_FALSE(verdict.passed);
  CHECK(verdict.error == Approx(0.1));
}

TEST_CASE("A value that is not a number never passes") {
  CHECK_FALSE(judge(test_with({reals("VALE_CALC", 0.0)}), "TEST_RESU", "x", std::nan(""))[0].passed);
}

TEST_CASE("Integers and texts are compared as such") {
  CHECK(judge(test_with({keyword("VALE_CALC_I", Value::tuple({Value(3)}))}), "TEST_RESU", "x", std::int64_t{3})[0]
            .passed);
  CHECK_FALSE(judge(test_with({keyword("VALE_CALC_I", Value::tuple({Value(3)}))}), "TEST_RESU", "x", std::int64_t{4})[0]
                  .passed);
  CHECK(judge(test_with({keyword("VALE_CALC_K", Value::tuple({Value("A")}))}), "TEST_RESU", "x", std::string("A"))[0]
            .passed);
}
