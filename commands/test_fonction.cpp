#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/functions/operations.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

/// The names of the values in VALE_PARA: NOM_PARA, else the function's own parameters in their order.
std::vector<std::string> names_of(const Keywords& test, const FunctionConcept& function, std::size_t count) {
  auto names = test.texts("NOM_PARA");
  if (names.empty()) names = function.parameters();
  if (names.empty()) names.resize(count);  // a constant does not ask
  if (names.size() == count) return names;
  throw DiagnosticError(
      "wrong-count", fmt::format("TEST_FONCTION: VALE_PARA has {} values for {} parameters", count, names.size()),
      test.span_of("VALE_PARA"), fmt::format("the function depends on {}", fmt::join(function.parameters(), ", ")));
}

// Of one parameter Code_Aster does not look at its name (U4.92.02).
std::vector<std::string> names_or_own(const Keywords& test, const FunctionConcept& function, std::size_t count,
                                      Context& context) {
  auto names = names_of(test, function, count);
  const auto own = function.parameters();
  if (names.size() != 1 || own.size() != 1 || names == own) return names;
  context.diagnostics.alarm("other-parameter",
                            fmt::format("TEST_FONCTION: {} depends on {}, and is tested there, not at a value of {}",
                                        test.concept_of("FONCTION")->name, own.front(), names.front()),
                            test.span_of("NOM_PARA"), fmt::format("write NOM_PARA='{}', or leave it out", own.front()));
  return own;
}

std::string name_in_verdicts(const Keywords& test) {
  return test.has("LEGENDE") ? test.text("LEGENDE") : test.concept_of("FONCTION")->name;
}

double mean_of(const Keywords& test, double from, double to) {
  const auto& function = test.data<FunctionConcept>("FONCTION");
  if (from >= to)
    throw DiagnosticError("out-of-bounds", fmt::format("TEST_FONCTION: INTERVALLE goes from {:g} to {:g}", from, to),
                          test.span_of("INTERVALLE"), "write the lower bound first");
  if (const auto* table = function.table()) return solver::mean_between(*table, from, to);
  if (dynamic_cast<const ConstantConcept*>(&function) != nullptr) return function.evaluate({});
  throw DiagnosticError("wrong-type",
                        fmt::format("TEST_FONCTION: {} is no table of one parameter, and has no mean over an interval",
                                    test.concept_of("FONCTION")->name),
                        test.span_of("FONCTION"),
                        dynamic_cast<const SurfaceConcept*>(&function) != nullptr
                            ? "take one of its functions by RECU_FONCTION(NAPPE=...)"
                            : "tabulate a formula by CALC_FONC_INTERP");
}

void test_mean(const Keywords& test, Context& context) {
  const auto bounds = test.reals("INTERVALLE");
  const double value = mean_of(test, bounds[0], bounds[1]);
  const std::string label = fmt::format("{} mean from {:g} to {:g}", name_in_verdicts(test), bounds[0], bounds[1]);
  for (Verdict& verdict : judge_function(test, label, value)) context.report(std::move(verdict));
}

void test_value(const Keywords& test, Context& context) {
  const auto& function = test.data<FunctionConcept>("FONCTION");
  const auto at = test.reals("VALE_PARA");
  const auto names = names_or_own(test, function, at.size(), context);
  const double value = evaluate_named(function, names, at, test.span_of("NOM_PARA"));
  std::string label = name_in_verdicts(test);
  for (std::size_t i = 0; i < at.size(); ++i) label += fmt::format("{} {}={:g}", i == 0 ? " at" : ",", names[i], at[i]);
  for (Verdict& verdict : judge_function(test, label, value)) context.report(std::move(verdict));
}

std::string attribute_of(const solver::TabulatedFunction& table, const std::string& name) {
  if (name == "NOM_PARA") return table.parameter;
  if (name == "NOM_RESU") return table.result;
  if (name == "PROL_GAUCHE") return word_of(table.left);
  if (name == "PROL_DROITE") return word_of(table.right);
  return fmt::format("{} {}", word_of(table.x_scale), word_of(table.y_scale));
}

// The one of PARA, else the first: they have the parameter in common.
const solver::TabulatedFunction& row_of(const Keywords& test, const SurfaceConcept& surface) {
  if (!test.given("PARA")) return *surface.rows().front();
  const double wanted = test.real("PARA");
  return surface.row_near(wanted,
                          test.real("PREC_PARA") * (test.text("CRIT_PARA") == "RELATIF" ? std::abs(wanted) : 1.0),
                          test.span_of("PARA"));
}

std::string attribute(const Keywords& test) {
  const auto& function = test.data<FunctionConcept>("FONCTION");
  const auto* surface = dynamic_cast<const SurfaceConcept*>(&function);
  const std::string& name = test.text("ATTR");
  const bool of_rows = name.ends_with("_FONC");
  if (surface != nullptr)
    return of_rows ? attribute_of(row_of(test, *surface), name.substr(0, name.size() - 5))
                   : attribute_of(surface->edges(), name);
  if (function.table() != nullptr && !of_rows) return attribute_of(*function.table(), name);
  throw DiagnosticError(
      "wrong-type", fmt::format("TEST_FONCTION: {} has no attribute {}", test.concept_of("FONCTION")->name, name),
      test.span_of("ATTR"),
      of_rows ? "functions of two parameters (DEFI_NAPPE) have it" : "functions that are given by points have it");
}

// One interpolation stands for that of the parameter and of the value.
std::string attribute_expected(const Keywords& test) {
  const std::string& expected = test.text("ATTR_REFE");
  return expected == "LIN" || expected == "LOG" ? expected + " " + expected : expected;
}

void test_attribute(const Keywords& test, Context& context) {
  const std::string label = fmt::format("{} {}", test.concept_of("FONCTION")->name, test.text("ATTR"));
  context.report(judge_text(test, "TEST_FONCTION", label, attribute_expected(test), attribute(test)));
}

}  // namespace

Product test_fonction(const Call& call, Context& context) {
  for (const Keywords& test : call.factors("VALEUR")) {
    if (test.given("INTERVALLE"))
      test_mean(test, context);
    else
      test_value(test, context);
  }
  for (const Keywords& test : call.factors("ATTRIBUT")) test_attribute(test, context);
  return nullptr;
}

}  // namespace comma::commands
