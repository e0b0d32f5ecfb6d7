#include <fmt/format.h>

#include <algorithm>

#include "commands/commands.hpp"
#include "commands/tables/result_tables.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

const ResultConcept& result_of(const Call& call) {
  const auto* result = dynamic_cast<const ResultConcept*>(call.concept_of("CO")->data.get());
  if (result != nullptr) return *result;
  throw DiagnosticError(
      "unsupported",
      fmt::format("RECU_TABLE: {} is no result, and other concepts keep no tables here", call.concept_of("CO")->name),
      call.span_of("CO"));
}

Cell parameter_of(const solver::ResultStep& step, const std::string& name) {
  if (name == "INST") return step.instant;
  const auto found = step.parameters.find(name);
  return found == step.parameters.end() ? Cell() : parameter_cell(name, found->second);
}

void warn_of_unknown_parameters(const Call& call, const solver::Result& result, Context& context) {
  for (const std::string& name : call.texts("NOM_PARA")) {
    const auto has = [&](const solver::ResultStep& step) {
      return !std::holds_alternative<std::monostate>(parameter_of(step, name));
    };
    if (std::ranges::any_of(result.steps, has)) continue;
    context.diagnostics.alarm(
        "unknown-parameter",
        fmt::format("RECU_TABLE: {} has no parameter {}, and the column is empty", call.concept_of("CO")->name, name),
        call.span_of("NOM_PARA"));
  }
}

Table parameter_table(const Call& call, const solver::Result& result) {
  Table table;
  for (const solver::ResultStep& step : result.steps) {
    std::vector<std::pair<std::string, Cell>> row = {{"NUME_ORDRE", std::int64_t{step.order}}};
    for (const std::string& name : call.texts("NOM_PARA")) row.emplace_back(name, parameter_of(step, name));
    table.add_row(row);
  }
  return table;
}

Table named_table(const Call& call, const ResultConcept& data) {
  const std::string& name = call.text("NOM_TABLE");
  if (auto table = table_of_result(data, name)) return *std::move(table);
  throw DiagnosticError(
      "unknown-table", fmt::format("RECU_TABLE: {} has no table {}", call.concept_of("CO")->name, name),
      call.span_of("NOM_TABLE"),
      name == "OBSERVATION"      ? "ask for it by OBSERVATION in STAT_NON_LINE"
      : name == "ANALYSE_MODALE" ? "ask for it by CRIT_STAB in STAT_NON_LINE"
                                 : "results have the tables PARA_CALC, OBSERVATION and ANALYSE_MODALE");
}

}  // namespace

Product recu_table(const Call& call, Context& context) {
  const ResultConcept& data = result_of(call);
  if (call.has("NOM_PARA")) warn_of_unknown_parameters(call, data.result, context);
  auto product = std::make_shared<TableConcept>();
  product->table = call.has("NOM_TABLE") ? named_table(call, data) : parameter_table(call, data.result);
  return product;
}

}  // namespace comma::commands
