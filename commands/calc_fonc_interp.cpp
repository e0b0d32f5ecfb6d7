#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/commands.hpp"
#include "commands/function_building.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

// A formula at the points of a list (U4.32.01); what is not said is as in the source, where that is a table itself.
Product calc_fonc_interp(const Call& call, Context&) {
  const auto& source = call.data<FunctionConcept>("FONCTION");
  if (source.parameters().size() > 1) {
    throw interpreter::DiagnosticError("unsupported",
                                       fmt::format("CALC_FONC_INTERP: {} depends on {}; comma tabulates functions of one parameter",
                                                   call.concept_of("FONCTION")->name, fmt::join(source.parameters(), ", ")),
                                       call.span_of("FONCTION"));
  }
  solver::TabulatedFunction function;
  if (const auto* table = source.table()) function = *table;
  if (!source.parameters().empty()) function.parameter = source.parameters().front();
  if (call.has("NOM_PARA")) function.parameter = call.text("NOM_PARA");
  if (call.has("NOM_RESU")) function.result = call.text("NOM_RESU");
  const bool by_list = call.has("LIST_PARA");
  function.x = by_list ? call.data<ListConcept>("LIST_PARA").values : call.reals("VALE_PARA");
  check_rising(call, by_list ? "LIST_PARA" : "VALE_PARA", function.x);
  function.y.clear();
  for (const double x : function.x) function.y.push_back(source.evaluate({&x, 1}));
  read_shape(call, function);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

}  // namespace comma::commands
