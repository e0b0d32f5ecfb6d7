#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

const solver::TabulatedFunction& points_of(const Keywords& curve) {
  const auto* table = curve.data<FunctionConcept>("FONCTION").table();
  if (table != nullptr) return *table;
  throw DiagnosticError("unsupported", fmt::format("IMPR_FONCTION: {} is not given by points", curve.concept_of("FONCTION")->name),
                        curve.span_of("FONCTION"), "tabulate it by CALC_FONC_INTERP");
}

// The abscissae of the first function lead; the others are interpolated there (U4.33.01).
Table columns_of(const std::vector<Keywords>& curves) {
  const auto& first = points_of(curves.front());
  Table table;
  table.columns = {first.parameter};
  for (const double x : first.x) table.rows.push_back({x});
  for (const Keywords& curve : curves) {
    const auto& function = points_of(curve);
    table.columns.push_back(curve.has("LEGENDE") ? curve.text("LEGENDE") : curve.concept_of("FONCTION")->name);
    for (std::size_t i = 0; i < first.x.size(); ++i) table.rows[i].emplace_back(function(first.x[i]));
  }
  return table;
}

}  // namespace

Product impr_fonction(const Call& call, Context& context) {
  constexpr int result_unit = 8;
  Table table = columns_of(call.factors("COURBE"));
  if (call.has("TITRE")) table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n# "));
  const auto path = context.files.output(static_cast<int>(call.integer("UNITE")), "resu", result_unit);
  context.write(path, format_table(table, " ", "E12.5") + "\n");
  return nullptr;
}

}  // namespace comma::commands
