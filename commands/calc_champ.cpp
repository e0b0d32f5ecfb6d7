#include <fmt/format.h>

#include "commands/commands.hpp"
#include "commands/result_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/field_computation.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// What the result was computed with, but for what the call gives in its place.
solver::StaticProblem problem_of(const Call& call, const ResultConcept& source) {
  solver::StaticProblem problem = source.problem;
  if (call.has("MODELE")) problem.model = call.data<ModelConcept>("MODELE").model;
  if (call.has("CHAM_MATER")) problem.materials = call.data<MaterialFieldConcept>("CHAM_MATER").field;
  if (call.has("CARA_ELEM")) problem.properties = call.data<PropertiesConcept>("CARA_ELEM").properties;
  if (!problem.model || !problem.materials) {
    throw DiagnosticError("missing-keyword", fmt::format("CALC_CHAMP: {} keeps no {}", call.concept_of("RESULTAT")->name, problem.model ? "materials" : "model"),
                          call.span_of("RESULTAT"), problem.model ? "give CHAM_MATER" : "give MODELE and CHAM_MATER");
  }
  return problem;
}

std::vector<std::string> wanted_fields(const Call& call) {
  std::vector<std::string> names;
  for (const char* keyword : {"CONTRAINTE", "DEFORMATION", "ENERGIE", "CRITERES", "FORCE"}) {
    for (const std::string& name : call.texts(keyword)) names.push_back(name);
  }
  return names;
}

void add_fields(const Call& call, ResultConcept& data) {
  const solver::StaticProblem problem = problem_of(call, data);
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

// A new result holds the fields of the one that it is computed from, and the new ones beside them.
Product calc_champ(const Call& call, Context&) {
  auto& source = call.data<ResultConcept>("RESULTAT");
  if (call.reuse) {
    add_fields(call, source);
    return nullptr;
  }
  auto product = std::make_shared<ResultConcept>(source);
  add_fields(call, *product);
  return product;
}

}  // namespace comma::commands
