#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

std::shared_ptr<const solver::TabulatedFunction> row_of(const Call& call, const interpreter::ConceptPtr& handle) {
  const auto* table = interpreter::data_of<FunctionConcept>(handle, "FONCTION").table();
  if (table != nullptr) return std::make_shared<const solver::TabulatedFunction>(*table);
  throw DiagnosticError("unsupported", fmt::format("DEFI_NAPPE: {} is not given by points", handle->name),
                        call.span_of("FONCTION"), "tabulate it by CALC_FONC_INTERP");
}

// A function that is defined in place.
std::shared_ptr<const solver::TabulatedFunction> row_of(const Keywords& occurrence, const std::string& parameter) {
  solver::TabulatedFunction row;
  row.parameter = parameter;
  read_pairs(occurrence, row);
  check_rising(occurrence, "VALE", row.x);
  read_shape(occurrence, row);
  return std::make_shared<const solver::TabulatedFunction>(std::move(row));
}

}  // namespace

Product defi_nappe(const Call& call, Context&) {
  solver::TabulatedFunction edges;
  edges.parameter = call.text("NOM_PARA");
  edges.result = call.text("NOM_RESU");
  edges.x = call.reals("PARA");
  check_rising(call, "PARA", edges.x);
  read_shape(call, edges);
  std::vector<std::shared_ptr<const solver::TabulatedFunction>> rows;
  for (const auto& handle : call.concepts("FONCTION")) rows.push_back(row_of(call, handle));
  for (const Keywords& occurrence : call.factors("DEFI_FONCTION"))
    rows.push_back(row_of(occurrence, call.text("NOM_PARA_FONC")));
  if (rows.size() != edges.x.size()) {
    throw DiagnosticError("wrong-count",
                          fmt::format("DEFI_NAPPE: {} functions stand against {} values", rows.size(), edges.x.size()),
                          call.span_of(call.given("FONCTION") ? "FONCTION" : "DEFI_FONCTION"),
                          "give one function for each value of PARA");
  }
  for (const auto& row : rows) {
    if (row->parameter == rows.front()->parameter) continue;
    throw DiagnosticError(
        "wrong-parameter",
        fmt::format("DEFI_NAPPE: the functions depend on {} and on {}", rows.front()->parameter, row->parameter),
        call.span_of("FONCTION"), "all of them have one and the same parameter");
  }
  return std::make_shared<SurfaceConcept>(std::move(edges), std::move(rows));
}

}  // namespace comma::commands
