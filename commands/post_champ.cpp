#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "commands/analysis/problem_building.hpp"
#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/stresses/plate_forces.hpp"
#include "solver/fields/stresses/plate_stresses.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

std::vector<int> chosen_cells(const Call& call, const solver::Mesh& mesh) {
  if (call.given("GROUP_MA") || call.given("MAILLE")) return selected_cells(call, mesh);
  std::vector<int> all(static_cast<std::size_t>(mesh.cell_count()));
  for (int cell = 0; cell < mesh.cell_count(); ++cell) all[static_cast<std::size_t>(cell)] = cell;
  return all;
}

solver::ElementField layer_of(const Keywords& occurrence, const std::string& name, const solver::ResultStep& step,
                              const std::vector<int>& cells) {
  static const std::map<std::string, solver::LayerSide, std::less<>> sides = {
      {"INF", solver::LayerSide::lower}, {"MOY", solver::LayerSide::middle}, {"SUP", solver::LayerSide::upper}};
  const solver::Field& field = layered_field_of(occurrence, step, name);
  if (!is_layered(field))
    throw DiagnosticError("wrong-field", fmt::format("EXTR_COQUE: {} has one value a point", name),
                          occurrence.span_of("NOM_CHAM"),
                          "take stresses or strains of plates, such as SIGM_ELNO, SIEQ_ELNO or EPSI_ELNO");
  const auto& layered = std::get<solver::ElementField>(field);
  solver::ElementField taken =
      solver::values_in_layer(solver::on_cells(layered, cells), static_cast<int>(occurrence.integer("NUME_COUCHE")),
                              sides.at(occurrence.text("NIVE_COUCHE")));
  if (!taken.values.empty()) return taken;
  throw DiagnosticError(
      "out-of-bounds", fmt::format("EXTR_COQUE: none of these cells has a layer {}", occurrence.integer("NUME_COUCHE")),
      occurrence.span_of("NUME_COUCHE"),
      fmt::format("layers count from 1 to {} (COQUE_NCOU of AFFE_CARA_ELEM)", solver::most_layers(layered)));
}

}  // namespace

// The new result holds the fields that are taken or moved, alone.
Product post_champ(const Call& call, Context& context) {
  const auto& source = call.data<ResultConcept>("RESULTAT");
  const auto cells = chosen_cells(call, source.result.mesh());
  auto product = std::make_shared<ResultConcept>();
  product->problem = source.problem;
  product->earlier = source.earlier;
  product->result.model = source.result.model;
  warn_of_missing_instants("POST_CHAMP", call, context.diagnostics);
  for (const solver::ResultStep* chosen : selected_steps(call, source.result)) {
    solver::ResultStep step = solver::without_fields(*chosen);
    for (const Keywords& occurrence : call.factors("EXTR_COQUE"))
      for (const std::string& name : occurrence.texts("NOM_CHAM"))
        step.fields.insert_or_assign(name, layer_of(occurrence, name, *chosen, cells));
    for (const Keywords& occurrence : call.factors("COQU_EXCENT")) {
      const solver::StaticProblem problem = problem_of_result(call, source, chosen);
      const auto* forces = std::get_if<solver::ElementField>(&field_of(occurrence, *chosen));
      if (forces == nullptr)
        throw DiagnosticError("wrong-field", "COQU_EXCENT wants a field on cells", occurrence.span_of("NOM_CHAM"));
      step.fields.insert_or_assign(occurrence.text("NOM_CHAM"),
                                   solver::forces_about_middle(*problem.model, *problem.properties, *forces, cells));
    }
    product->result.steps.push_back(std::move(step));
  }
  return product;
}

}  // namespace comma::commands
