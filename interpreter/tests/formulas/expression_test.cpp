#include "interpreter/formulas/expression.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace comma::interpreter;

namespace {

VariableLookup in(std::map<std::string, Value, std::less<>> values) {
  return [values = std::move(values)](std::string_view name) -> std::optional<Value> {
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional<Value>(found->second);
  };
}

std::string failure(const std::string& text) {
  try {
    Expression(text).evaluate(in({}));
  } catch (const DiagnosticError& error) {
    return error.diagnostic().code;
  }
  return "";
}

}  // namespace

TEST_CASE("The condition of a block is an expression over keywords", "[expression]") {
  const Expression condition("FORMULATION == 'DISCRETE' and ALGO_CONT in ('CONTRAINTE', 'GCP')");
  CHECK(condition.holds(in({{"FORMULATION", "DISCRETE"}, {"ALGO_CONT", "GCP"}})));
  CHECK_FALSE(condition.holds(in({{"FORMULATION", "CONTINUE"}, {"ALGO_CONT", "GCP"}})));
  CHECK_FALSE(condition.holds(in({{"FORMULATION", "DISCRETE"}, {"ALGO_CONT", Value()}})));
  CHECK(condition.variables() == std::vector<std::string>{"FORMULATION", "ALGO_CONT"});
}

TEST_CASE("A keyword that is not given is None", "[expression]") {
  CHECK(Expression("X is None").holds(in({{"X", Value()}})));
  CHECK_FALSE(Expression("X is not None and X > 3").holds(in({{"X", Value()}})));
}

TEST_CASE("A formula knows math, and its variables come in order of use", "[expression]") {
  const Expression formula("sin(X)*Y + 2.0*pi + e + sum(v for v in (X, Z))");
  CHECK(formula.variables() == std::vector<std::string>{"X", "Y", "Z"});
  const double value = formula.evaluate(in({{"X", 0.5}, {"Y", 3.0}, {"Z", 1}})).as_real();
  CHECK(value == Approx(std::sin(0.5) * 3.0 + 2.0 * M_PI + M_E + 1.5).epsilon(1e-15));
}

TEST_CASE("A variable of the lookup hides a name of math", "[expression]") {
  CHECK(Expression("e * 2").evaluate(in({{"e", 3}})).as_integer() == 6);
}

TEST_CASE("An expression may run over several lines", "[expression]") {
  CHECK(Expression("\n  1 +\n 2\n").evaluate(in({})).as_integer() == 3);
}

TEST_CASE("A lambda or comprehension variable is not free", "[expression]") {
  CHECK(Expression("[x + A for x in B]").variables() == std::vector<std::string>{"B", "A"});
}

TEST_CASE("An unknown keyword makes the value unknown and the condition false", "[expression]") {
  CHECK(Expression("X == 1").evaluate(in({{"X", Value::unknown()}})).is_unknown());
  CHECK_FALSE(Expression("X == 1").holds(in({{"X", Value::unknown()}})));
}

TEST_CASE("What goes wrong has a code", "[expression]") {
  CHECK(failure("1 +") == "syntax");
  CHECK(failure("") == "syntax");
  CHECK(failure("a b") == "syntax");
  CHECK(failure("x = 1") == "syntax");
  CHECK(failure("'abc") == "syntax");
  CHECK(failure("nothing") == "unknown-name");
  CHECK(failure("1 / 0") == "zero-division");
  CHECK(failure("'a' + 1") == "type-error");
  CHECK(failure("(x for x in [1])") == "type-error");
  CHECK(failure("lambda: 1") == "type-error");
}
