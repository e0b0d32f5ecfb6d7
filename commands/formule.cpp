#include <algorithm>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

void check_parameters(const Call& call, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool twice = std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
                       names.begin() + static_cast<std::ptrdiff_t>(i);
    if (twice)
      throw DiagnosticError("repeated-parameter", "FORMULE: NOM_PARA names " + names[i] + " twice",
                            call.span_of("NOM_PARA"));
    if (call.given(names[i])) {
      throw DiagnosticError("repeated-parameter", "FORMULE: " + names[i] + " is a parameter and a further keyword",
                            call.span_of(names[i]), "the formula cannot tell them apart: rename one of them");
    }
  }
}

}  // namespace

Product formule(const Call& call, Context&) {
  const auto names = call.texts("NOM_PARA");
  check_parameters(call, names);
  interpreter::FormulaBindings bindings;
  for (const auto& keyword : call.items) {
    if (keyword.name != "NOM_PARA" && keyword.name != "VALE") bindings.emplace(keyword.name, keyword.value);
  }
  const auto& span = call.span_of("VALE");
  try {
    return std::make_shared<FormulaConcept>(interpreter::Formula(call.text("VALE"), names, std::move(bindings), "VALE"),
                                            span);
  } catch (const DiagnosticError& error) {
    interpreter::Diagnostic found = error.diagnostic();
    found.span = span;
    throw DiagnosticError(std::move(found));
  }
}

}  // namespace comma::commands
