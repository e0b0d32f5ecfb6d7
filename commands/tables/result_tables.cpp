#include "commands/tables/result_tables.hpp"

#include <algorithm>
#include <cmath>

namespace comma::commands {

namespace {

std::int64_t number_of_phase(const ResultConcept& data, const solver::ResultStep& step) {
  return std::ranges::count_if(data.earlier, [&](const EarlierPhase& phase) { return phase.last_order < step.order; });
}

// Of a result that no computation of several steps has made: one row a step.
Table parameters_of_steps(const ResultConcept& data) {
  Table table;
  for (const solver::ResultStep& step : data.result.steps) {
    Row row = {{"NUME_REUSE", number_of_phase(data, step)}, {"INST", step.instant}};
    for (const auto& [name, value] : step.parameters) row.emplace_back(name, parameter_cell(name, value));
    row.emplace_back("NUME_ORDRE", std::int64_t{step.order});
    table.add_row(row);
  }
  return table;
}

// One row a step that was computed, the initial state included; NUME_ORDRE of those that are kept.
Table computation(const ResultConcept& data) {
  if (!data.computed) return parameters_of_steps(data);
  Table table = data.computed->table;
  const auto phase = static_cast<std::size_t>(table.column("NUME_REUSE"));
  const auto instant = static_cast<std::size_t>(table.column("INST"));
  const auto order = static_cast<std::size_t>(table.add_column("NUME_ORDRE"));
  for (auto& row : table.rows) {
    const auto found = std::ranges::find_if(data.result.steps, [&](const solver::ResultStep& step) {
      return Cell(step.instant) == row[instant] && Cell(number_of_phase(data, step)) == row[phase];
    });
    if (found != data.result.steps.end()) row[order] = std::int64_t{found->order};
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
