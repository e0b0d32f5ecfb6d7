#include "commands/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/tables/table.hpp"

namespace comma::commands {

using interpreter::Keywords;

namespace {

double as_double(const TestedValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  return std::get<double>(value);
}

// A relative criterion has no meaning around a zero reference: then the error is absolute, unless ORDRE_GRANDEUR gives
// the scale that it is relative to.
void compare(Verdict& verdict) {
  const TestedValue& computed = *verdict.computed;
  if (std::holds_alternative<std::string>(verdict.reference) || std::holds_alternative<std::string>(computed)) {
    const auto* one = std::get_if<std::string>(&verdict.reference);
    const auto* other = std::get_if<std::string>(&computed);
    verdict.passed = one != nullptr && other != nullptr && without_padding(*one) == without_padding(*other);
    verdict.error = verdict.passed ? 0.0 : 1.0;
    return;
  }
  const double reference = as_double(verdict.reference);
  const double scale = std::abs(verdict.order_of_magnitude.value_or(reference));
  if (scale == 0.0) verdict.relative = false;
  const double difference = std::abs(as_double(computed) - reference);
  verdict.error = verdict.relative ? difference / scale : difference;
  verdict.passed = verdict.error <= verdict.tolerance;  // false for a NaN
}

// Of several admitted values the nearest counts (U4.92.01).
template <class Number>
TestedValue nearest_to(const TestedValue& computed, const std::vector<Number>& references) {
  if (std::holds_alternative<std::string>(computed)) return references.front();
  const double value = as_double(computed);
  return *std::min_element(references.begin(), references.end(), [&](Number a, Number b) {
    return std::abs(static_cast<double>(a) - value) < std::abs(static_cast<double>(b) - value);
  });
}

/// Whether the references are compared without their signs as well.
enum class Signs : std::uint8_t { kept, dropped };

template <class Number>
TestedValue reference_among(std::vector<Number> references, Signs signs, const TestedValue& computed) {
  if (signs == Signs::dropped)
    for (Number& reference : references) reference = std::abs(reference);
  return nearest_to(computed, references);
}

std::optional<TestedValue> given_reference(const Keywords& test, const std::string& stem, Signs signs,
                                           const TestedValue& computed) {
  if (test.given(stem)) return reference_among(test.reals(stem), signs, computed);
  if (test.given(stem + "_I")) return reference_among(test.integers(stem + "_I"), signs, computed);
  if (test.given(stem + "_K")) return test.texts(stem + "_K").front();
  return std::nullopt;
}

TestedValue tested_value(const interpreter::Value& value) {
  if (value.is_real()) return value.as_real();
  if (value.is_integer()) return value.as_integer();
  return value.is_none() ? "" : value.repr();
}

Verdict verdict_at(const Keywords& test, const std::string& command, const std::string& label,
                   const TestedValue& computed) {
  Verdict verdict;
  verdict.file = test.span ? test.span.file->path() : "";
  verdict.line = test.span ? test.span.file->position(test.span.begin).line : 0;
  verdict.command = command;
  verdict.label = label;
  verdict.computed = computed;
  return verdict;
}

bool drops_signs(const Keywords& test) { return test.has("VALE_ABS") && test.text("VALE_ABS") == "OUI"; }

/// What VALE_CALC and VALE_REFE share: the value, without its sign where VALE_ABS asks for that, and CRITERE.
Verdict verdict_on_number(const Keywords& test, const std::string& command, const std::string& label,
                          const TestedValue& computed) {
  Verdict verdict = verdict_at(test, command, label, computed);
  verdict.relative = test.texts("CRITERE").empty() || test.texts("CRITERE").front() == "RELATIF";
  if (!drops_signs(test)) return verdict;
  if (const auto* real = std::get_if<double>(&computed)) verdict.computed = std::abs(*real);
  if (const auto* integer = std::get_if<std::int64_t>(&computed)) verdict.computed = std::abs(*integer);
  return verdict;
}

std::vector<Verdict> verdicts_on(const Keywords& test, const Verdict& common, Signs signs,
                                 std::optional<double> order_of_magnitude) {
  std::vector<Verdict> verdicts;
  if (const auto reference = given_reference(test, "VALE_CALC", signs, *common.computed)) {
    Verdict verdict = common;
    verdict.kind = "VALE_CALC";
    verdict.reference_type = "NON_REGRESSION";
    verdict.reference = *reference;
    verdict.tolerance = test.reals("TOLE_MACHINE").front();
    verdict.order_of_magnitude = order_of_magnitude;
    if (order_of_magnitude) verdict.relative = true;
    compare(verdict);
    verdicts.push_back(std::move(verdict));
  }
  if (const auto reference = given_reference(test, "VALE_REFE", signs, *common.computed)) {
    Verdict verdict = common;
    verdict.kind = "VALE_REFE";
    verdict.reference_type = test.has("REFERENCE") ? test.text("REFERENCE") : "NON_DEFINI";
    verdict.reference = *reference;
    verdict.tolerance = test.reals("PRECISION").front();
    compare(verdict);
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

}  // namespace

std::vector<Verdict> judge(const Keywords& test, const std::string& command, const std::string& label,
                           const TestedValue& computed) {
  std::optional<double> order_of_magnitude;
  if (test.given("ORDRE_GRANDEUR")) order_of_magnitude = test.real("ORDRE_GRANDEUR");
  return verdicts_on(test, verdict_on_number(test, command, label, computed),
                     drops_signs(test) ? Signs::dropped : Signs::kept, order_of_magnitude);
}

std::vector<Verdict> judge_function(const Keywords& test, const std::string& label, double computed) {
  return verdicts_on(test, verdict_on_number(test, "TEST_FONCTION", label, computed), Signs::kept, std::nullopt);
}

Verdict judge_text(const Keywords& test, const std::string& command, const std::string& label,
                   const std::string& expected, const std::string& computed) {
  Verdict verdict = verdict_at(test, command, label, computed);
  verdict.kind = "VALE_REFE";
  verdict.reference_type = test.has("REFERENCE") ? test.text("REFERENCE") : "NON_DEFINI";
  verdict.reference = expected;
  verdict.relative = false;
  compare(verdict);
  return verdict;
}

namespace {

/// assertEqual, assertAlmostEqual ..., assertIs, assertIsNone: their two values are the same where they hold.
bool claims_equality(std::string_view method) {
  return (method.ends_with("Equal") && !method.starts_with("assertNot") && !method.ends_with("LessEqual") &&
          !method.ends_with("GreaterEqual")) ||
         method == "assertIs" || method == "assertIsNone";
}

}  // namespace

Verdict verdict_of(const interpreter::Assertion& assertion) {
  Verdict verdict;
  verdict.file = assertion.span ? assertion.span.file->path() : "";
  verdict.line = assertion.span ? assertion.span.file->position(assertion.span.begin).line : 0;
  verdict.command = "TestCase";
  verdict.label = assertion.message.empty() ? assertion.method : assertion.method + ": " + assertion.message;
  verdict.kind = "VALE_REFE";
  verdict.reference_type = "ASSERTION";
  if (claims_equality(assertion.method)) {
    verdict.computed = tested_value(assertion.computed);
    verdict.reference = tested_value(assertion.reference);
  } else {
    // The figures of an entry agree where it holds: of another claim it is its truth that is tested.
    verdict.computed = std::int64_t{assertion.holds ? 1 : 0};
    verdict.reference = std::int64_t{1};
  }
  verdict.relative = false;
  verdict.tolerance = assertion.tolerance;
  const bool numbers = assertion.computed.is_number() && assertion.reference.is_number();
  if (numbers) verdict.error = std::abs(assertion.computed.as_real() - assertion.reference.as_real());
  if (!numbers && !assertion.holds) verdict.error = 1.0;
  verdict.passed = assertion.holds;
  return verdict;
}

std::string format_verdict(const Verdict& verdict) {
  const auto shown = [](const TestedValue& value) {
    if (const auto* real = std::get_if<double>(&value)) return fmt::format("{:.9g}", *real);
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
    return std::get<std::string>(value);
  };
  return fmt::format("  {:<7}{:<28} {} {:>15}  for {:>15}  {} error {:.1e} {} {:.0e}", verdict.passed ? "ok" : "FAILED",
                     verdict.label, verdict.kind, verdict.computed ? shown(*verdict.computed) : "nothing",
                     shown(verdict.reference), verdict.relative ? "relative" : "absolute", verdict.error,
                     verdict.passed ? "<=" : "over", verdict.tolerance);
}

}  // namespace comma::commands
