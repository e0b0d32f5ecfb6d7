#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/functions/operations.hpp"

namespace comma::commands {

namespace {

using interpreter::ConceptPtr;
using interpreter::DiagnosticError;
using solver::TabulatedFunction;

// Tables, and constants after the first one, which have no points of their own.
class Tables {
 public:
  void add(const Keywords& operation, const ConceptPtr& handle, const char* keyword = "FONCTION") {
    const auto& concept_data = interpreter::data_of<FunctionConcept>(handle, keyword);
    if (const auto* table = concept_data.table()) {
      all_.push_back(table);
      return;
    }
    if (all_.empty() || !concept_data.parameters().empty())
      throw DiagnosticError("unsupported", fmt::format("CALC_FONCTION: {} is no table of one parameter", handle->name),
                            operation.span_of(keyword), "tabulate a formula by CALC_FONC_INTERP");
    const double at = 1.0;  // it counts as a point of the sum (17.3)
    constants_.push_back({.x = {at},
                          .y = {concept_data.evaluate({&at, 1})},
                          .left = solver::Extension::constant,
                          .right = solver::Extension::constant});
    all_.push_back(&constants_.back());
  }
  operator solver::Functions() const { return all_; }
  const TabulatedFunction& operator[](std::size_t i) const { return *all_[i]; }

 private:
  std::deque<TabulatedFunction> constants_;  // do not move as it grows
  std::vector<const TabulatedFunction*> all_;
};

const TabulatedFunction& table_of(const Keywords& operation, const char* keyword = "FONCTION") {
  Tables tables;
  tables.add(operation, operation.concept_of(keyword), keyword);
  return tables[0];
}

Tables tables_of(const std::vector<Keywords>& occurrences) {
  Tables tables;
  for (const Keywords& occurrence : occurrences) tables.add(occurrence, occurrence.concept_of("FONCTION"));
  return tables;
}

Tables tables_of(const Keywords& operation) {
  Tables tables;
  for (const auto& handle : operation.concepts("FONCTION")) tables.add(operation, handle);
  return tables;
}

// COMB and MULT come at the points of all functions, and LIST_PARA takes the result elsewhere.
TabulatedFunction at_abscissas(const Call& call, TabulatedFunction function) {
  if (!call.has("LIST_PARA")) return function;
  std::vector<double> values = call.data<ListConcept>("LIST_PARA").values;
  check_rising(call, "LIST_PARA", values);
  return solver::resampled(function, std::move(values));
}

TabulatedFunction combined(const Call& call) {
  const std::vector<Keywords>& terms = call.factors("COMB");
  std::vector<double> coefficients;
  for (const Keywords& term : terms) coefficients.push_back(term.real("COEF"));
  return at_abscissas(call, solver::combination(tables_of(terms), coefficients));
}

TabulatedFunction succession(const Keywords& operation) {
  const Tables tables = tables_of(operation);
  return solver::in_succession(
      tables[0], tables[1], operation.text("SURCHARGE") == "GAUCHE" ? solver::Overlap::left : solver::Overlap::right);
}

TabulatedFunction envelope(const Keywords& operation) {
  const Tables tables = tables_of(operation);
  return operation.text("CRITERE") == "SUP" ? solver::upper_envelope(tables) : solver::lower_envelope(tables);
}

TabulatedFunction power(const Keywords& operation) {
  const auto exponent = static_cast<double>(operation.integer("EXPOSANT"));
  return solver::mapped(table_of(operation), [exponent](double y) { return std::pow(y, exponent); });
}

// A line that goes on may change its sign: it ends.
TabulatedFunction magnitude(const TabulatedFunction& function) {
  TabulatedFunction result = solver::mapped(function, [](double y) { return std::abs(y); });
  for (solver::Extension* end : {&result.left, &result.right})
    if (*end == solver::Extension::linear) *end = solver::Extension::excluded;
  return result;
}

// Code_Aster names what it derives and integrates along this chain, and keeps other names.
std::string next_of(const std::string& name, int step) {
  constexpr std::array chain = {"DEPL", "VITE", "ACCE"};
  const auto found = std::ranges::find(chain, name);
  if (found == chain.end()) return name;
  return chain[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(found - chain.begin() + step, 0, 2))];
}

TabulatedFunction named(TabulatedFunction function, std::string result) {
  function.result = std::move(result);
  return function;
}

TabulatedFunction integral(const Keywords& operation) {
  const auto rule = operation.text("METHODE") == "SIMPSON" ? solver::simpson_integral : solver::integral;
  const TabulatedFunction& function = table_of(operation);
  return named(rule(function, operation.real("COEF")), next_of(function.result, -1));
}

TabulatedFunction derivative(const Keywords& operation) {
  const TabulatedFunction& function = table_of(operation);
  return named(solver::derivative(function), next_of(function.result, 1));
}

TabulatedFunction composition(const Keywords& operation) {
  const TabulatedFunction& outer = table_of(operation, "FONC_RESU");
  const TabulatedFunction& inner = table_of(operation, "FONC_PARA");
  if (inner.result != outer.parameter)
    throw DiagnosticError(
        "other-parameter",
        fmt::format("CALC_FONCTION: {} depends on {}, and {} gives {}", operation.concept_of("FONC_RESU")->name,
                    outer.parameter, operation.concept_of("FONC_PARA")->name, inner.result),
        operation.span_of("FONC_PARA"), fmt::format("define it with NOM_RESU='{}'", outer.parameter));
  return solver::composition(outer, inner);
}

TabulatedFunction computed(const Call& call) {
  const auto only = [&](const char* keyword) -> const Keywords& { return call.factor(keyword); };
  if (call.given("COMB")) return combined(call);
  if (call.given("MULT")) return at_abscissas(call, solver::product(tables_of(call.factors("MULT"))));
  if (call.given("ENVELOPPE")) return envelope(only("ENVELOPPE"));
  if (call.given("MOYENNE")) return solver::mean(tables_of(only("MOYENNE")));
  if (call.given("ASSE")) return succession(only("ASSE"));
  if (call.given("FRACTILE")) return solver::fractile(tables_of(only("FRACTILE")), only("FRACTILE").real("FRACT"));
  if (call.given("REGR_POLYNOMIALE"))
    return solver::polynomial_fit(table_of(only("REGR_POLYNOMIALE")),
                                  static_cast<int>(only("REGR_POLYNOMIALE").integer("DEGRE")));
  if (call.given("ABS")) return magnitude(table_of(only("ABS")));
  if (call.given("PUISSANCE")) return power(only("PUISSANCE"));
  if (call.given("INTEGRE")) return integral(only("INTEGRE"));
  if (call.given("DERIVE")) return derivative(only("DERIVE"));
  if (call.given("INVERSE")) return named(solver::inverse(table_of(only("INVERSE"))), "TOUTRESU");
  return composition(only("COMPOSE"));
}

}  // namespace

// Functions out of functions (U4.32.04).
Product calc_fonction(const Call& call, Context&) {
  if (call.has("LIST_PARA") && !call.given("COMB") && !call.given("MULT"))
    throw DiagnosticError("contradictory-keywords", "CALC_FONCTION: LIST_PARA goes with COMB and MULT alone",
                          call.span_of("LIST_PARA"), "leave it out, and tabulate the result anew by CALC_FONC_INTERP");
  TabulatedFunction function = computed(call);
  if (call.has("NOM_PARA")) function.parameter = call.text("NOM_PARA");
  if (call.has("NOM_RESU")) function.result = call.text("NOM_RESU");
  read_shape(call, function);
  check_scales(call, function);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

}  // namespace comma::commands
