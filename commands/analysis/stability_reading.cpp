#include "commands/analysis/stability_reading.hpp"

#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::InstabilitySign;
using solver::ModeSelection;

InstabilitySign sign_named(const std::string& word) {
  if (word == "NEGATIF") return InstabilitySign::negative;
  return word == "POSITIF" ? InstabilitySign::positive : InstabilitySign::either;
}

void take_interval(const Keywords& given, solver::StabilityAnalysis& analysis) {
  const auto bounds = given.reals("CHAR_CRIT");
  if (!(bounds[0] < bounds[1]))
    throw DiagnosticError("wrong-order", "STAT_NON_LINE: CHAR_CRIT of CRIT_STAB is no interval",
                          given.span_of("CHAR_CRIT"), "give the smaller bound first");
  analysis.selection = ModeSelection::band;
  analysis.first = bounds[0];
  analysis.last = bounds[1];
}

void take_instants(const Keywords& given, solver::StabilityAnalysis& analysis) {
  if (given.has("INST")) analysis.instants = given.reals("INST");
  if (given.has("LIST_INST")) analysis.instants = given.data<ListConcept>("LIST_INST").values;
  analysis.instant_tolerance = given.real("PRECISION");
  analysis.absolute_tolerance = given.text("CRITERE") == "ABSOLU";
  if (given.has("PAS_CALC")) analysis.period = static_cast<int>(given.integer("PAS_CALC"));
}

// Modes are numbered by rising values.
void add_rows(const solver::StabilityReport& report, Table& table) {
  std::int64_t number = 0;
  for (const solver::CriticalMode& mode : report.modes)
    table.add_row({{"INST", report.instant},
                   {"TYPE_MODE", std::string("MODE_FLAMB")},
                   {"NUME_MODE", ++number},
                   {"CHAR_CRIT", mode.value}});
}

}  // namespace

std::optional<solver::StabilityAnalysis> stability_analysis(const Call& call, ResultConcept& product) {
  if (!call.has("CRIT_STAB")) return std::nullopt;
  const Keywords& given = call.factor("CRIT_STAB");
  solver::StabilityAnalysis analysis;
  analysis.geometric = given.text("RIGI_GEOM") == "OUI";
  analysis.precision = given.real("PREC_INSTAB");
  analysis.sign = sign_named(given.text("SIGNE"));
  if (given.text("OPTION") == "BANDE")
    take_interval(given, analysis);
  else
    analysis.count = static_cast<int>(given.integer("NMAX_CHAR_CRIT"));
  take_instants(given, analysis);
  if (given.has("DDL_EXCLUS"))
    for (const std::string& name : given.texts("DDL_EXCLUS"))
      if (const auto component = solver::component_named(name)) analysis.excluded.push_back(*component);
  if (!product.modes) product.modes.emplace();
  analysis.report = [&product](const solver::StabilityReport& report) {
    add_rows(report, product.modes->table);
    product.modes->end_step(product.result.steps.back().order);
  };
  return analysis;
}

}  // namespace comma::commands
