#include "commands/tables/result_tables.hpp"

#include <algorithm>
#include <cmath>

namespace comma::commands {

namespace {

// One row a step, the initial state (which has no parameters) included.
Table computation(const ResultConcept& data) {
  Table table;
  for (const solver::ResultStep& step : data.result.steps) {
    const auto later =
        std::ranges::count_if(data.earlier, [&](const EarlierPhase& phase) { return phase.last_order < step.order; });
    std::vector<std::pair<std::string, Cell>> row = {
        {"NUME_ORDRE", std::int64_t{step.order}}, {"NUME_REUSE", std::int64_t{later}}, {"INST", step.instant}};
    for (const auto& [name, value] : step.parameters) row.emplace_back(name, parameter_cell(name, value));
    table.add_row(row);
  }
  return table;
}

}  // namespace

Cell parameter_cell(std::string_view parameter, double value) {
  return parameter == "ITER_GLOB" ? Cell(static_cast<std::int64_t>(std::lround(value))) : Cell(value);
}

void StepTable::forget_after(int order) {
  ends.erase(ends.upper_bound(order), ends.end());
  table.rows.resize(ends.empty() ? 0 : ends.rbegin()->second);
}

std::optional<Table> table_of_result(const ResultConcept& data, std::string_view name) {
  if (name == "PARA_CALC") return computation(data);
  const auto kept = [](const std::optional<StepTable>& any) { return any ? std::optional(any->table) : std::nullopt; };
  if (name == "ANALYSE_MODALE") return kept(data.modes);
  return name == "OBSERVATION" ? kept(data.observations) : std::nullopt;
}

}  // namespace comma::commands
