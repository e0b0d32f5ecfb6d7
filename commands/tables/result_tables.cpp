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

std::optional<Table> table_of_result(const ResultConcept& data, std::string_view name) {
  if (name == "PARA_CALC") return computation(data.result);
  if (name == "ANALYSE_MODALE") return data.modes;
  return name == "OBSERVATION" ? data.observations : std::nullopt;
}

}  // namespace comma::commands
