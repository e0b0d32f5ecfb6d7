#include "commands/analysis/step_record.hpp"

#include "commands/tables/result_tables.hpp"
#include "solver/fields/field_computation.hpp"

namespace comma::commands {

namespace {

const solver::NodalField& displacement_of(const solver::ResultStep& step) {
  return std::get<solver::NodalField>(step.fields.at("DEPL"));
}

// Of a computation that another one goes on with, at the instant where it does.
double work_at(const std::optional<StepTable>& computed, double instant) {
  if (!computed || computed->table.column("TRAV_EXT") < 0) return 0.0;
  const auto work = static_cast<std::size_t>(computed->table.column("TRAV_EXT"));
  const auto when = static_cast<std::size_t>(computed->table.column("INST"));
  double found = 0.0;
  for (const auto& row : computed->table.rows)
    if (row[when] == Cell(instant)) found = number_in(row[work]).value_or(0.0);
  return found;
}

}  // namespace

StepRecorder::StepRecorder(const interpreter::Call& call, ResultConcept& computed, double start)
    : computed_(computed), with_energies_(call.has("ENERGIE")) {
  if (!computed_.computed) computed_.computed.emplace();
  if (!with_energies_) return;
  if (!computed_.result.steps.empty()) {
    const solver::ResultStep& last = computed_.result.steps.back();
    work_ = {displacement_of(last), forces_of_last_step(), work_at(computed_.computed, last.instant)};
  } else if (call.has("ETAT_INIT") && call.factor("ETAT_INIT").has("EVOL_NOLI")) {
    work_ = solver::RunningWork(work_at(call.factor("ETAT_INIT").data<ResultConcept>("EVOL_NOLI").computed, start));
  }
}

solver::NodalField StepRecorder::forces_of_last_step() const {
  solver::FieldComputation computation(computed_.problem, computed_.result);
  return std::get<solver::NodalField>(computation.compute("FORC_NODA", computed_.result.steps.size() - 1));
}

// Steps are in balance: internal forces do the work of external ones. Nothing moves by itself, and nothing is damped.
void StepRecorder::add_energies(Row& row) {
  const double work = work_.add(displacement_of(computed_.result.steps.back()), forces_of_last_step()).real;
  row.insert(row.end(), {{"TRAV_EXT", work},
                         {"ENER_CIN", 0.0},
                         {"ENER_TOT", work},
                         {"TRAV_AMOR", 0.0},
                         {"TRAV_LIAI", 0.0},
                         {"DISS_SCH", 0.0}});
}

void StepRecorder::take() {
  const solver::ResultStep& step = computed_.result.steps.back();
  Row row = {{"NUME_REUSE", static_cast<std::int64_t>(computed_.earlier.size())}, {"INST", step.instant}};
  if (with_energies_) add_energies(row);
  for (const auto& [name, value] : step.parameters) row.emplace_back(name, parameter_cell(name, value));
  computed_.computed->table.add_row(row);
}

}  // namespace comma::commands
