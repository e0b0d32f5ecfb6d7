#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

/// The names of the values in VALE_PARA: NOM_PARA, else the function's own parameters in their order.
std::vector<std::string> names_of(const Keywords& test, const FunctionConcept& function, std::size_t count) {
  auto names = test.texts("NOM_PARA");
  if (names.empty()) names = function.parameters();
  if (names.empty()) names.resize(count);  // a constant does not ask
  if (names.size() == count) return names;
  throw DiagnosticError("wrong-count", fmt::format("TEST_FONCTION: VALE_PARA has {} values for {} parameters", count, names.size()),
                        test.span_of("VALE_PARA"), fmt::format("the function depends on {}", fmt::join(function.parameters(), ", ")));
}

void test_value(const Keywords& test, Context& context) {
  const auto& function = test.data<FunctionConcept>("FONCTION");
  const auto at = test.reals("VALE_PARA");
  const auto names = names_of(test, function, at.size());
  const double value = evaluate_named(function, names, at, test.span_of("NOM_PARA"));
  std::string label = test.has("LEGENDE") ? test.text("LEGENDE") : test.concept_of("FONCTION")->name;
  for (std::size_t i = 0; i < at.size(); ++i) label += fmt::format("{} {}={:g}", i == 0 ? " at" : ",", names[i], at[i]);
  for (Verdict& verdict : judge(test, "TEST_FONCTION", label, value)) context.report(std::move(verdict));
}

}  // namespace

Product test_fonction(const Call& call, Context& context) {
  for (const Keywords& test : call.factors("VALEUR")) test_value(test, context);
  return nullptr;
}

}  // namespace comma::commands
