#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/functions/operations.hpp"

namespace comma::commands {

namespace {

using solver::TabulatedFunction;
using Tables = std::vector<const TabulatedFunction*>;

const TabulatedFunction& table_of(const Keywords& operation, const interpreter::ConceptPtr& handle,
                                  const char* keyword) {
  if (const auto* table = interpreter::data_of<FunctionConcept>(handle, keyword).table()) return *table;
  throw interpreter::DiagnosticError("unsupported",
                                     fmt::format("CALC_FONCTION: {} is no table of one parameter", handle->name),
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

// Where COMB and MULT are tabulated, if it is said.
std::vector<double> abscissas(const Call& call) {
  if (!call.has("LIST_PARA")) return {};
  std::vector<double> values = call.data<ListConcept>("LIST_PARA").values;
  check_rising(call, "LIST_PARA", values);
  return values;
}

TabulatedFunction combined(const Call& call) {
  const std::vector<Keywords>& terms = call.factors("COMB");
  std::vector<double> coefficients;
  for (const Keywords& term : terms) coefficients.push_back(term.real("COEF"));
  return solver::combination(tables_of(terms), coefficients, abscissas(call));
}

TabulatedFunction succession(const Keywords& operation) {
  const Tables tables = tables_of(operation);
  return solver::in_succession(
      *tables[0], *tables[1],
      operation.text("SURCHARGE") == "GAUCHE" ? solver::Overlap::first : solver::Overlap::second);
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
  if (call.given("COMB")) return combined(call);
  if (call.given("MULT")) return solver::product(tables_of(call.factors("MULT")), abscissas(call));
  if (call.given("ENVELOPPE")) return envelope(only("ENVELOPPE"));
  if (call.given("MOYENNE")) return solver::mean(tables_of(only("MOYENNE")));
  if (call.given("ASSE")) return succession(only("ASSE"));
  if (call.given("FRACTILE")) return solver::fractile(tables_of(only("FRACTILE")), only("FRACTILE").real("FRACT"));
  if (call.given("REGR_POLYNOMIALE"))
    return solver::polynomial_fit(table_of(only("REGR_POLYNOMIALE")),
                                  static_cast<int>(only("REGR_POLYNOMIALE").integer("DEGRE")));
  if (call.given("ABS")) return solver::mapped(table_of(only("ABS")), [](double y) { return std::abs(y); });
  if (call.given("PUISSANCE")) return power(only("PUISSANCE"));
  if (call.given("INTEGRE")) {
    const auto rule = only("INTEGRE").text("METHODE") == "SIMPSON" ? solver::simpson_integral : solver::integral;
    return rule(table_of(only("INTEGRE")), only("INTEGRE").real("COEF"));
  }
  if (call.given("DERIVE")) return solver::derivative(table_of(only("DERIVE")));
  if (call.given("INVERSE")) return solver::inverse(table_of(only("INVERSE")));
  const Keywords& composed = only("COMPOSE");
  return solver::composition(table_of(composed, "FONC_RESU"), table_of(composed, "FONC_PARA"));
}

}  // namespace

// Functions out of functions (U4.32.04).
Product calc_fonction(const Call& call, Context&) {
  if (call.has("LIST_PARA") && !call.given("COMB") && !call.given("MULT"))
    throw interpreter::DiagnosticError(
        "contradictory-keywords", "CALC_FONCTION: LIST_PARA goes with COMB and MULT alone", call.span_of("LIST_PARA"),
        "leave it out, and tabulate the result anew by CALC_FONC_INTERP");
  TabulatedFunction function = computed(call);
  if (call.has("NOM_PARA")) function.parameter = call.text("NOM_PARA");
  if (call.has("NOM_RESU")) function.result = call.text("NOM_RESU");
  read_shape(call, function);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

}  // namespace comma::commands
