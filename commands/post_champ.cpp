#include <algorithm>

#include "commands/commands.hpp"
#include "commands/problem_building.hpp"
#include "commands/result_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/plate_forces.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

std::vector<int> chosen_cells(const Call& call, const solver::Mesh& mesh) {
  if (call.given("GROUP_MA") || call.given("MAILLE")) return selected_cells(call, mesh);
  std::vector<int> all(static_cast<std::size_t>(mesh.cell_count()));
  for (int cell = 0; cell < mesh.cell_count(); ++cell) all[static_cast<std::size_t>(cell)] = cell;
  return all;
}

}  // namespace

// The new result holds the moved fields alone.
Product post_champ(const Call& call, Context&) {
  const auto& source = call.data<ResultConcept>("RESULTAT");
  const solver::StaticProblem problem = problem_of_result(call, source);
  const auto cells = chosen_cells(call, *problem.model->mesh);
  auto product = std::make_shared<ResultConcept>();
  product->problem = source.problem;
  product->result.model = source.result.model;
  for (const solver::ResultStep* chosen : selected_steps(call, source.result)) {
    solver::ResultStep step{chosen->order, chosen->instant, {}, chosen->parameters};
    for (const Keywords& occurrence : call.factors("COQU_EXCENT")) {
      const auto* forces = std::get_if<solver::ElementField>(&field_of(occurrence, *chosen));
      if (forces == nullptr) throw DiagnosticError("wrong-field", "COQU_EXCENT wants a field on cells", occurrence.span_of("NOM_CHAM"));
      step.fields.insert_or_assign(occurrence.text("NOM_CHAM"),
                                   solver::forces_about_middle(*problem.model, *problem.properties, *forces, cells));
    }
    product->result.steps.push_back(std::move(step));
  }
  return product;
}

}  // namespace comma::commands
