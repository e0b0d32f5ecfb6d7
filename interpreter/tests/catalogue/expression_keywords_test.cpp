#include "interpreter/catalogue/expression_keywords.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "interpreter/tests/little_catalogue.hpp"

using namespace comma::interpreter;
using namespace comma::interpreter::tests;

namespace {

const char* const rule_page = R"(
command: RULE
doc: A function.
category: functions
keywords:
  NAMES: {type: parameter, required: true, max: many, doc: Parameters.}
  VALUE: {type: expression, required: true, doc: Expression.}
further: {type: anything, doc: What it uses.}
)";

struct Bound {
  CommandCall call;
  Diagnostics diagnostics;
  bool sound = false;

  const Value* find(const std::string& name) const {
    const auto found = std::ranges::find(call.arguments, name, &Argument::name);
    return found == call.arguments.end() ? nullptr : found->value.get();
  }
};

Bound bind(const Arguments& arguments, const std::vector<std::pair<std::string, Value>>& variables) {
  const LittleCatalogue little({rule_page});
  Bound bound;
  bound.call = written_call("RULE", arguments);
  bound.call.scope = [&](std::string_view name) -> std::optional<Value> {
    const auto found = std::ranges::find_if(variables, [&](const auto& item) { return item.first == name; });
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  bound.sound = bind_expressions(bound.call, little.catalogue->page("RULE"), bound.diagnostics);
  return bound;
}

}  // namespace

TEST_CASE("A variable of the file that an expression uses becomes an argument of the call") {
  const Bound bound = bind({{"NAMES", Value("X")}, {"VALUE", Value("a * X + e")}},
                           {{"a", Value(3.0)}, {"e", Value(1.0)}, {"b", Value(2.0)}});
  REQUIRE(bound.sound);
  REQUIRE(bound.find("a") != nullptr);
  CHECK(bound.find("a")->as_real() == 3.0);
  CHECK(bound.find("e")->as_real() == 1.0);  // the file's own e, not that of math
  CHECK(bound.find("b") == nullptr);
}

TEST_CASE("What the call gives and what it names as parameter is not looked for") {
  const Bound bound =
      bind({{"NAMES", Value::tuple({Value("X"), Value("Y")})}, {"VALUE", Value("a * X + Y")}, {"a", Value(5.0)}},
           {{"a", Value(3.0)}, {"X", Value(7.0)}, {"Y", Value(8.0)}});
  REQUIRE(bound.sound);
  CHECK(bound.find("a")->as_real() == 5.0);
  CHECK(bound.call.arguments.size() == 3);
}

TEST_CASE("An expression that cannot be read, or uses an unknown name, is reported where it stands") {
  const Bound broken = bind({{"NAMES", Value("X")}, {"VALUE", Value("2 * (X")}}, {});
  CHECK_FALSE(broken.sound);
  REQUIRE(broken.diagnostics.items().size() == 1);
  CHECK(broken.diagnostics.items()[0].code == "syntax");
  CHECK(text_at(broken.diagnostics.items()[0].span) == "'2 * (X'");
  const Bound unknown = bind({{"NAMES", Value("X")}, {"VALUE", Value("slop * X + slop + sin(X)")}}, {});
  CHECK_FALSE(unknown.sound);
  REQUIRE(unknown.diagnostics.items().size() == 1);
  CHECK(unknown.diagnostics.items()[0].code == "unknown-name");
}
