#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// Rising values by VALE_... or by LIST_....
std::vector<double> values_of(const Call& call, const std::string& suffix) {
  const std::string list = "LIST_" + suffix, own = "VALE_" + suffix;
  auto values = call.has(list) ? call.data<ListConcept>(list).values : call.reals(own);
  check_rising(call, call.has(list) ? list : own, values);
  return values;
}

Product tabulated(const Call& call, const FunctionConcept& source) {
  if (source.parameters().size() > 1) {
    throw DiagnosticError("unsupported",
                          fmt::format("CALC_FONC_INTERP: {} depends on {}; a table of one parameter cannot hold it",
                                      call.concept_of("FONCTION")->name, fmt::join(source.parameters(), ", ")),
                          call.span_of("FONCTION"),
                          "give NOM_PARA_FONC with values: a function of two parameters is made");
  }
  solver::TabulatedFunction function;
  if (!source.parameters().empty()) function.parameter = source.parameters().front();
  if (call.has("NOM_PARA")) function.parameter = call.text("NOM_PARA");
  if (call.has("NOM_RESU")) function.result = call.text("NOM_RESU");
  function.x = values_of(call, "PARA");
  function.y.clear();
  for (const double x : function.x) function.y.push_back(source.evaluate({&x, 1}));
  read_shape(call, function);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

// The place of NOM_PARA among the two parameters of the source; the first where it is not given.
std::size_t place_of_first(const Call& call, const FunctionConcept& source) {
  const auto& names = source.parameters();
  if (names.size() != 2) {
    throw DiagnosticError("wrong-count",
                          fmt::format("CALC_FONC_INTERP: {} depends on {} parameters, a function of two is to be made",
                                      call.concept_of("FONCTION")->name, names.size()),
                          call.span_of("FONCTION"));
  }
  if (!call.has("NOM_PARA")) return names[0] == call.text("NOM_PARA_FONC") ? 1 : 0;
  for (std::size_t i = 0; i < 2; ++i)
    if (names[i] == call.text("NOM_PARA")) return i;
  throw DiagnosticError(
      "unknown-parameter",
      fmt::format("CALC_FONC_INTERP: {} depends on {} and {}", call.concept_of("FONCTION")->name, names[0], names[1]),
      call.span_of("NOM_PARA"));
}

// One table along the second parameter for each value of the first.
Product tabulated_surface(const Call& call, const FunctionConcept& source) {
  const std::size_t first = place_of_first(call, source);
  solver::TabulatedFunction edges;
  edges.parameter = source.parameters()[first];
  edges.x = values_of(call, "PARA");
  read_shape(call, edges);
  solver::TabulatedFunction row;
  row.parameter = call.has("NOM_PARA_FONC") ? call.text("NOM_PARA_FONC") : source.parameters()[1 - first];
  row.x = values_of(call, "PARA_FONC");
  read_shape(call, row, "_FONC");
  std::vector<std::shared_ptr<const solver::TabulatedFunction>> rows;
  for (const double at_first : edges.x) {
    row.y.clear();
    for (const double at_second : row.x) {
      std::array<double, 2> at;
      at[first] = at_first;
      at[1 - first] = at_second;
      row.y.push_back(source.evaluate(at));
    }
    rows.push_back(std::make_shared<const solver::TabulatedFunction>(row));
  }
  return std::make_shared<SurfaceConcept>(std::move(edges), std::move(rows));
}

}  // namespace

// A function at the points of a list (U4.32.01); what is not said is linear, ends there, and has no name.
Product calc_fonc_interp(const Call& call, Context&) {
  const auto& source = call.data<FunctionConcept>("FONCTION");
  const bool surface = call.has("VALE_PARA_FONC") || call.has("LIST_PARA_FONC");
  return surface ? tabulated_surface(call, source) : tabulated(call, source);
}

}  // namespace comma::commands
