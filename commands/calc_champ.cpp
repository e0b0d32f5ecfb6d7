#include "commands/commands.hpp"
#include "commands/problem_building.hpp"
#include "commands/result_reading.hpp"
#include "commands/selection.hpp"
#include "solver/fields/field_computation.hpp"

namespace comma::commands {

namespace {

std::vector<std::string> wanted_fields(const Call& call) {
  std::vector<std::string> names;
  for (const char* keyword : {"CONTRAINTE", "DEFORMATION", "ENERGIE", "CRITERES", "FORCE", "VARI_INTERNE"}) {
    for (const std::string& name : call.texts(keyword)) names.push_back(name);
  }
  return names;
}

void add_fields(const Call& call, ResultConcept& data) {
  const solver::StaticProblem problem = problem_of_result(call, data);
  solver::FieldComputation computation(problem, data.result);
  std::optional<std::vector<int>> cells;
  if (call.given("GROUP_MA") || call.given("MAILLE")) cells = selected_cells(call, data.result.mesh());
  for (const solver::ResultStep* chosen : selected_steps(call, data.result)) {
    const auto index = static_cast<std::size_t>(chosen - data.result.steps.data());
    for (const std::string& name : wanted_fields(call)) {
      solver::Field field = cells ? computation.compute(name, index, *cells) : computation.compute(name, index);
      data.result.steps[index].fields.insert_or_assign(name, std::move(field));
    }
  }
}

}  // namespace

Product calc_champ(const Call& call, Context&) {
  return result_with(call, [&](ResultConcept& result) { add_fields(call, result); });
}

}  // namespace comma::commands
