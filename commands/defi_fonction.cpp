#include <algorithm>
#include <numeric>

#include "commands/commands.hpp"
#include "commands/function_building.hpp"
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
  if (call.text("VERIF") == "CROISSANT" && !std::is_sorted(function.x.begin(), function.x.end())) {
    throw DiagnosticError("wrong-order", "DEFI_FONCTION: the abscissas do not rise", call.span, "put the points in order, or give VERIF=\"NON\"");
  }
  std::vector<std::size_t> order(function.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return function.x[a] < function.x[b]; });
  std::vector<double> x, y;
  for (const std::size_t i : order) {
    if (!x.empty() && x.back() == function.x[i]) {
      throw DiagnosticError("repeated-abscissa", "DEFI_FONCTION: the abscissa " + std::to_string(function.x[i]) + " stands twice",
                            call.span, "a function has one value at each abscissa; make a jump a steep ramp");
    }
    x.push_back(function.x[i]);
    y.push_back(function.y[i]);
  }
  function.x = std::move(x);
  function.y = std::move(y);
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
  return std::make_shared<TabulatedConcept>(std::move(function));
}

Product defi_constante(const Call& call, Context&) { return std::make_shared<ConstantConcept>(call.real("VALE")); }

}  // namespace comma::commands
