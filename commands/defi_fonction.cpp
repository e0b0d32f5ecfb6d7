#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

void read_points(const Call& call, solver::TabulatedFunction& function) {
  if (call.has("VALE")) return read_pairs(call, function);
  const bool by_lists = call.has("VALE_PARA");
  function.x = by_lists ? call.data<ListConcept>("VALE_PARA").values : call.reals("ABSCISSE");
  function.y = by_lists ? call.data<ListConcept>("VALE_FONC").values : call.reals("ORDONNEE");
  if (function.x.size() != function.y.size()) {
    throw DiagnosticError("wrong-count",
                          "DEFI_FONCTION: " + std::to_string(function.x.size()) + " abscissas stand against " +
                              std::to_string(function.y.size()) + " ordinates",
                          call.span);
  }
}

// Abscissas rise unless VERIF="NON" lets comma sort them; two points never share one (U4.31.02).
void sort_points(const Call& call, solver::TabulatedFunction& function) {
  const auto where = call.span_of(call.has("VALE") ? "VALE" : call.has("VALE_PARA") ? "VALE_PARA" : "ABSCISSE");
  const auto back = std::ranges::is_sorted_until(function.x);
  if (call.text("VERIF") == "CROISSANT" && back != function.x.end())
    throw DiagnosticError(
        "wrong-order",
        fmt::format("DEFI_FONCTION: the abscissas do not rise: {:g} comes after {:g}", *back, *std::prev(back)), where,
        "put the points in order, or give VERIF=\"NON\"");
  function.sort_points();
  if (const auto twice = std::ranges::adjacent_find(function.x); twice != function.x.end())
    throw DiagnosticError("repeated-abscissa", fmt::format("DEFI_FONCTION: the abscissa {:g} stands twice", *twice),
                          where, "a function has one value at each abscissa; make a jump a steep ramp");
}

}  // namespace

Product defi_fonction(const Call& call, Context&) {
  solver::TabulatedFunction function;
  function.parameter = call.text("NOM_PARA");
  function.result = call.text("NOM_RESU");
  if (call.result) function.name = call.result->name;
  read_points(call, function);
  sort_points(call, function);
  read_shape(call, function);
  check_scales(call, function);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

Product defi_constante(const Call& call, Context&) { return std::make_shared<ConstantConcept>(call.real("VALE")); }

}  // namespace comma::commands
