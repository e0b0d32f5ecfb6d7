// A compiled formula against the walk over its tree: same value to the last bits, or the same error.
#include "interpreter/formulas/formula.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "interpreter/diagnostic.hpp"
#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/syntax/parser.hpp"
#include "interpreter/tests/recording_host.hpp"

using namespace comma::interpreter;
using comma::interpreter::testing::RecordingHost;

namespace {

const std::vector<std::string> parameters = {"X", "Y", "Z", "INST"};

// Random expressions over the whole grammar that a formula compiles; the depth bounds their size.
class Writer {
 public:
  explicit Writer(unsigned seed) : random_(seed) {}

  std::string expression(int depth) {
    if (depth == 0) return leaf();
    switch (pick(9)) {
      case 0:
        return "(" + expression(depth - 1) + any(arithmetic) + expression(depth - 1) + ")";
      case 1:
        return "(" + expression(depth - 1) + any(arithmetic) + leaf() + ")";
      case 2:
        return std::string(any(unary)) + "(" + expression(depth - 1) + ")";
      case 3:
        return std::string(any(binary)) + "(" + expression(depth - 1) + ", " + expression(depth - 1) + ")";
      case 4:
        return "(-" + expression(depth - 1) + ")";
      case 5:
        return "(" + expression(depth - 1) + " if " + condition(depth - 1) + " else " + expression(depth - 1) + ")";
      case 6:
        return "(" + expression(depth - 1) + any(logical) + expression(depth - 1) + ")";
      case 7:
        return "(" + condition(depth - 1) + " + " + expression(depth - 1) + ")";
      default:
        return "(not " + expression(depth - 1) + ")";
    }
  }

  double number() {
    constexpr std::array special = {0.0, 1.0, -1.0, 2.0, 0.5, -2.0, 1e200, -1e-200, 3.0};
    return pick(3) == 0 ? special[pick(special.size())] : std::uniform_real_distribution<double>(-5.0, 5.0)(random_);
  }

 private:
  static constexpr std::array arithmetic = {" + ", " - ", " * ", " / ", "**", " // ", " % "};
  static constexpr std::array compared = {" < ", " <= ", " > ", " >= ", " == ", " != "};
  static constexpr std::array logical = {" and ", " or "};
  static constexpr std::array unary = {"sin",  "cos",   "tan",  "asin", "acos",  "atan", "sinh",
                                       "cosh", "tanh",  "exp",  "log",  "log10", "sqrt", "abs",
                                       "fabs", "floor", "ceil", "int",  "float", "round"};
  static constexpr std::array binary = {"min", "max", "pow", "hypot"};
  static constexpr std::array leaves = {"X", "Y", "Z", "INST", "2", "3.0", "0.5", "pi", "e", "10", "-1", "1e-3"};

  std::size_t pick(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  template <class Words>
  const char* any(const Words& words) {
    return words[pick(words.size())];
  }
  std::string leaf() { return any(leaves); }
  std::string condition(int depth) {
    const std::string first = "(" + expression(depth) + any(compared) + leaf();
    return first + (pick(4) == 0 ? std::string(any(compared)) + leaf() : "") + ")";
  }

  std::mt19937 random_;
};

struct Outcome {
  std::optional<double> value;
  std::string code;
};

Outcome by_program(const Formula& formula, std::span<const double> arguments) {
  try {
    return {formula(arguments), ""};
  } catch (const DiagnosticError& error) {
    return {std::nullopt, error.diagnostic().code};
  }
}

Outcome by_tree(const Formula& formula, std::span<const double> arguments) {
  try {
    const std::vector<Value> values(arguments.begin(), arguments.end());
    const Value value = formula.evaluate_values(values);
    if (value.is_bool()) return {static_cast<double>(value.as_bool()), ""};
    if (value.is_number()) return {value.as_real(), ""};
    return {std::nullopt, "not-real"};
  } catch (const DiagnosticError& error) {
    return {std::nullopt, error.diagnostic().code};
  }
}

// Whole numbers are exact in the tree and doubles in the program: sums of large ones may differ in the last bits, which
// the functions around them enlarge.
constexpr double agreement = 1e-12;

bool same(const Outcome& a, const Outcome& b) {
  if (!a.value || !b.value) return a.code == b.code && a.value.has_value() == b.value.has_value();
  if (std::isnan(*a.value) || std::isnan(*b.value)) return std::isnan(*a.value) == std::isnan(*b.value);
  if (*a.value == *b.value) return true;
  return std::abs(*a.value - *b.value) <= agreement * std::max(std::abs(*a.value), std::abs(*b.value));
}

double evaluate(const std::string& text, double x, FormulaBindings bindings = {}) {
  return Formula(text, {"X"}, std::move(bindings))(std::array{x});
}

}  // namespace

TEST_CASE("A formula's program agrees with the tree on random expressions and arguments") {
  constexpr int expressions = 400, draws = 20;
  Writer writer(20240117);
  int compiled = 0, values = 0;
  for (int i = 0; i < expressions; ++i) {
    const std::string text = writer.expression(1 + i % 4);
    INFO(text);
    const Formula formula(text, parameters);
    compiled += formula.is_compiled() ? 1 : 0;
    for (int j = 0; j < draws; ++j) {
      const std::array arguments = {writer.number(), writer.number(), writer.number(), writer.number()};
      const Outcome fast = by_program(formula, arguments), slow = by_tree(formula, arguments);
      INFO("at " << arguments[0] << " " << arguments[1] << " " << arguments[2] << " " << arguments[3]);
      INFO("program " << (fast.value ? std::to_string(*fast.value) : fast.code) << ", tree "
                      << (slow.value ? std::to_string(*slow.value) : slow.code));
      REQUIRE(same(fast, slow));
      values += fast.value.has_value() ? 1 : 0;
    }
  }
  // The comparison says something only if most expressions are compiled and many cases have a value.
  CHECK(compiled > expressions * 9 / 10);
  CHECK(values > expressions * draws / 3);
}

TEST_CASE("Division, floor division and remainder of a formula follow Python's signs") {
  for (const double x : {7.0, -7.0, 7.5, -7.5}) {
    for (const double y : {2.0, -2.0}) {
      const Formula quotient("X // Y", {"X", "Y"}), remainder("X % Y", {"X", "Y"});
      const std::array at = {x, y};
      CHECK(quotient(at) == std::floor(x / y));
      CHECK(quotient(at) * y + remainder(at) == x);
    }
  }
  CHECK(evaluate("1 / 2 + X", 0.0) == 0.5);
}

TEST_CASE("Where Python raises, a formula raises the same") {
  const auto code = [](const std::string& text, double x) {
    try {
      evaluate(text, x);
    } catch (const DiagnosticError& error) {
      return error.diagnostic().code;
    }
    return std::string("none");
  };
  CHECK(code("1 / X", 0.0) == "zero-division");
  CHECK(code("X % 0.0", 1.0) == "zero-division");
  CHECK(code("sqrt(X)", -1.0) == code("sqrt(-1)", 0.0));
  CHECK(code("log(X)", 0.0) == code("log(0)", 0.0));
  CHECK(code("X**0.5", -2.0) == "not-real");
  CHECK(code("U + X", 0.0) == "unknown-name");
  CHECK(code("X +", 0.0) == "syntax");
  CHECK(code("[X]", 0.0) == "not-real");
}

TEST_CASE("Python's integers have no negative zero") {
  CHECK(evaluate("atan2(-(not X), -1)", 2.0) == Approx(3.14159265358979));
  CHECK(evaluate("atan2(-X, -1)", 0.0) == Approx(-3.14159265358979));
  CHECK(evaluate("atan2(int(X) * -1, -1)", 0.5) == Approx(3.14159265358979));
}

TEST_CASE("A branch that is not taken raises nothing") {
  CHECK(evaluate("1 / X if X != 0 else 5.0", 0.0) == 5.0);
  CHECK(evaluate("X != 0 and 1 / X", 0.0) == 0.0);
  CHECK(evaluate("1 / 0 if X > 1 else 2", 0.0) == 2.0);
}

TEST_CASE("A binding hides a builtin, a parameter hides a binding") {
  CHECK(evaluate("e * X", 2.0, {{"e", Value(3.0)}}) == 6.0);
  CHECK(evaluate("X + 1", 2.0, {{"X", Value(100.0)}}) == 3.0);
  CHECK(evaluate("T[1] * X", 2.0, {{"T", Value::list({Value(1.0), Value(4.0)})}}) == 8.0);
}

TEST_CASE("What depends on no parameter is computed once, exactly") {
  // 10**20 + 1 - 10**20 is 1 for Python's integers and 0 for doubles.
  const Formula formula("(10**20 + 1 - 10**20) * X", {"X"});
  CHECK(formula.is_compiled());
  CHECK(formula(std::array{2.0}) == 2.0);
}

TEST_CASE("A formula may be a list's or a text's business: the tree does it") {
  const Formula formula("max([X, 2.0]) + len('ab')", {"X"});
  CHECK_FALSE(formula.is_compiled());
  CHECK(formula(std::array{5.0}) == 7.0);
}

TEST_CASE("A formula calls functions that the file defines, with the file's own variables") {
  Diagnostics diagnostics;
  RecordingHost host;
  Evaluator evaluator(host, diagnostics, [](std::string_view) {});
  const auto file =
      std::make_shared<const SourceFile>("f.comm",
                                         "scale = 3.0\ndef f(x, power=2):\n  return scale * x**power\ndef bad(x):\n  "
                                         "return 1 / (x - x)\ndef word(x):\n  return 'a'\n");
  evaluator.run(parse(file, diagnostics));
  REQUIRE_FALSE(diagnostics.has_errors());
  const auto bound = [&](const char* name) { return FormulaBindings{{name, *evaluator.global(name)}}; };
  const Formula formula("f(X) + f(X, 1)", {"X"}, bound("f"));
  CHECK(formula.is_compiled());
  CHECK(formula(std::array{2.0}) == 18.0);
  CHECK(evaluate("len(word(X)) + X", 1.0, bound("word")) == 2.0);
  CHECK_THROWS_AS(evaluate("word(X)", 1.0, bound("word")), DiagnosticError);
  CHECK_THROWS_AS(evaluate("bad(X)", 1.0, bound("bad")), DiagnosticError);
}

namespace {

/// a * x + b, as a concept.
struct Line : ConceptData, RealFunction {
  std::vector<std::string> names = {"X"};
  const RealFunction* real_function() const override { return this; }
  const std::vector<std::string>& parameters() const override { return names; }
  double evaluate(std::span<const double> at) const override { return 2.0 * at[0] + 1.0; }
};

}  // namespace

TEST_CASE("A formula calls the functions of concepts") {
  auto line = std::make_shared<Concept>();
  line->type = "fonction_sdaster";
  line->data = std::make_shared<Line>();
  const Formula formula("L(X) * L(1.0)", {"X"}, {{"L", Value(line)}});
  CHECK(formula.is_compiled());
  CHECK(formula(std::array{3.0}) == 21.0);
}

namespace {

/// One whose evaluation calls so many others in turn.
struct Deep : Line {
  int nesting() const override { return 500; }
};

}  // namespace

TEST_CASE("Formulas within formulas end at a depth that the stack bears") {
  auto deep = std::make_shared<Concept>();
  deep->type = "fonction_sdaster";
  deep->data = std::make_shared<Line>();
  CHECK(Formula("L(X)", {"X"}, {{"L", Value(deep)}}).nesting() == 1);
  deep->data = std::make_shared<Deep>();
  CHECK_THROWS_WITH(Formula("L(X)", {"X"}, {{"L", Value(deep)}}), Catch::Contains("500 deep"));
}

TEST_CASE("A function of the file that fails in a formula has been called once") {
  Diagnostics diagnostics;
  RecordingHost host;
  Evaluator evaluator(host, diagnostics, [](std::string_view) {});
  const auto file = std::make_shared<const SourceFile>(
      "f.comm", "calls = []\ndef f(x):\n  calls.append(x)\n  raise ValueError('no')\n");
  evaluator.run(parse(file, diagnostics));
  const Formula formula("f(X) + 1.0", {"X"}, {{"f", *evaluator.global("f")}});
  REQUIRE(formula.is_compiled());
  CHECK_THROWS_AS(formula(std::array{2.0}), DiagnosticError);
  CHECK(evaluator.global("calls")->items().size() == 1);
}
