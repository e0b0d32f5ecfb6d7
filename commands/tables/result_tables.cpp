#include "commands/tables/result_tables.hpp"

namespace comma::commands {

namespace {

Table computation(const solver::Result& result) {
  Table table;
  for (const solver::ResultStep& step : result.steps) {
    if (step.order == 0) continue;  // the initial state was not computed
    std::vector<std::pair<std::string, Cell>> row = {{"NUME_ORDRE", std::int64_t{step.order}}, {"INST", step.instant}};
    for (const auto& [name, value] : step.parameters) row.emplace_back(name, value);
    table.add_row(row);
  }
  return table;
}

}  // namespace

void StepTable::forget_after(int order) {
  ends.erase(ends.upper_bound(order), ends.end());
  table.rows.resize(ends.empty() ? 0 : ends.rbegin()->second);
}

std::optional<Table> table_of_result(const ResultConcept& data, std::string_view name) {
  if (name == "PARA_CALC") return computation(data.result);
  const auto kept = [](const std::optional<StepTable>& any) { return any ? std::optional(any->table) : std::nullopt; };
  if (name == "ANALYSE_MODALE") return kept(data.modes);
  return name == "OBSERVATION" ? kept(data.observations) : std::nullopt;
}

}  // namespace comma::commands
