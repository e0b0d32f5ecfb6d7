#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "commands/commands.hpp"
#include "commands/function_building.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/functions/operations.hpp"

namespace comma::commands {

namespace {

using solver::TabulatedFunction;
using Tables = std::vector<const TabulatedFunction*>;

const TabulatedFunction& table_of(const Keywords& operation, const interpreter::ConceptPtr& handle, const char* keyword) {
  if (const auto* table = interpreter::data_of<FunctionConcept>(handle, keyword).table()) return *table;
  throw interpreter::DiagnosticError("unsupported", fmt::format("CALC_FONCTION: {} is no table of one parameter", handle->name),
                                     operation.span_of(keyword), "tabulate a formula by CALC_FONC_INTERP");
}

const TabulatedFunction& table_of(const Keywords& operation, const char* keyword = "FONCTION") {
  return table_of(operation, operation.concept_of(keyword), keyword);
}

Tables tables_of(const std::vector<Keywords>& occurrences) {
  Tables tables;
  for (const Keywords& occurrence : occurrences) tables.push_back(&table_of(occurrence));
  return tables;
}

Tables tables_of(const Keywords& operation) {
  Tables tables;
  for (const auto& handle : operation.concepts("FONCTION")) tables.push_back(&table_of(operation, handle, "FONCTION"));
  return tables;
}

TabulatedFunction combined(const std::vector<Keywords>& terms) {
  std::vector<double> coefficients;
  for (const Keywords& term : terms) coefficients.push_back(term.real("COEF"));
  return solver::combination(tables_of(terms), coefficients);
}

TabulatedFunction envelope(const Keywords& operation) {
  const Tables tables = tables_of(operation);
  return operation.text("CRITERE") == "SUP" ? solver::upper_envelope(tables) : solver::lower_envelope(tables);
}

TabulatedFunction power(const Keywords& operation) {
  const auto exponent = static_cast<double>(operation.integer("EXPOSANT"));
  return solver::mapped(table_of(operation), [exponent](double y) { return std::pow(y, exponent); });
}

TabulatedFunction computed(const Call& call) {
  const auto only = [&](const char* keyword) -> const Keywords& { return call.factor(keyword); };
  if (call.given("COMB")) return combined(call.factors("COMB"));
  if (call.given("MULT")) return solver::product(tables_of(call.factors("MULT")));
  if (call.given("ENVELOPPE")) return envelope(only("ENVELOPPE"));
  if (call.given("MOYENNE")) return solver::mean(tables_of(only("MOYENNE")));
  if (call.given("ABS")) return solver::mapped(table_of(only("ABS")), [](double y) { return std::abs(y); });
  if (call.given("PUISSANCE")) return power(only("PUISSANCE"));
  if (call.given("INTEGRE")) return solver::integral(table_of(only("INTEGRE")), only("INTEGRE").real("COEF"));
  if (call.given("DERIVE")) return solver::derivative(table_of(only("DERIVE")));
  if (call.given("INVERSE")) return solver::inverse(table_of(only("INVERSE")));
  const Keywords& composed = only("COMPOSE");
  return solver::composition(table_of(composed, "FONC_RESU"), table_of(composed, "FONC_PARA"));
}

}  // namespace

// Functions out of functions (U4.32.04).
Product calc_fonction(const Call& call, Context&) {
  TabulatedFunction function = computed(call);
  if (call.has("NOM_PARA")) function.parameter = call.text("NOM_PARA");
  if (call.has("NOM_RESU")) function.result = call.text("NOM_RESU");
  read_shape(call, function);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

}  // namespace comma::commands
