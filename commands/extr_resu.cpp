#include <algorithm>
#include <optional>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/restriction.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// The steps that are kept; with PAS_ARCH every so many, counted from 1.
std::vector<const solver::ResultStep*> kept_steps(const Keywords& archiving, const solver::Result& result) {
  if (!archiving.has("PAS_ARCH")) return selected_steps(archiving, result);
  std::vector<const solver::ResultStep*> steps;
  const auto pace = static_cast<std::size_t>(archiving.integer("PAS_ARCH"));
  for (std::size_t k = pace; k <= result.steps.size(); k += pace) steps.push_back(&result.steps[k - 1]);
  return steps;
}

void drop_fields(const Keywords& archiving, solver::ResultStep& step) {
  const auto named = archiving.texts("NOM_CHAM"), excluded = archiving.texts("CHAM_EXCLU");
  std::erase_if(step.fields, [&](const auto& entry) {
    const bool is_named = named.empty() || std::ranges::count(named, entry.first) != 0;
    return !is_named || std::ranges::count(excluded, entry.first) != 0;
  });
}

void archive(const Keywords& archiving, ResultConcept& product) {
  std::vector<solver::ResultStep> steps;
  for (const solver::ResultStep* step : kept_steps(archiving, product.result)) {
    steps.push_back(*step);
    drop_fields(archiving, steps.back());
  }
  if (steps.empty())
    throw DiagnosticError("unknown-step", "EXTR_RESU: no step would be left", archiving.span,
                          "look at PAS_ARCH and at the number of steps");
  product.result.steps = std::move(steps);
}

// What later computations go on from is that of the part; the loads of the whole are not those of it.
void restrict_to_part(const Keywords& restriction, ResultConcept& product) {
  solver::StaticProblem problem;
  problem.properties = std::make_shared<const solver::ElementProperties>();
  std::shared_ptr<const solver::Mesh> mesh;
  if (restriction.has("MODELE")) {
    problem.model = restriction.data<ModelConcept>("MODELE").model;
    mesh = problem.model->mesh;
  } else {
    mesh = restriction.data<MeshConcept>("MAILLAGE").mesh;
  }
  if (restriction.has("CHAM_MATER")) {
    const auto& materials = restriction.data<MaterialFieldConcept>("CHAM_MATER");
    require_mesh(restriction, "CHAM_MATER", materials.mesh.get(), *mesh);
    problem.materials = materials.field.get();
  }
  if (restriction.has("CARA_ELEM")) problem.properties = restriction.data<PropertiesConcept>("CARA_ELEM").properties;
  const solver::PartOfMesh part = solver::part_of(product.result.mesh(), *mesh);
  for (solver::ResultStep& step : product.result.steps) {
    step.contact = nullptr;
    for (auto& [name, field] : step.fields) field = solver::on_part(field, part);
  }
  product.result.model = problem.model;
  product.result.bare_mesh = mesh;
  product.problem = std::move(problem);
  product.earlier.clear();
}

}  // namespace

Product extr_resu(const Call& call, Context& context) {
  auto product = std::make_shared<ResultConcept>(call.data<ResultConcept>("RESULTAT"));
  for (const Keywords& archiving : call.factors("ARCHIVAGE")) {
    warn_of_missing_instants("EXTR_RESU", archiving, context.diagnostics);
    archive(archiving, *product);
  }
  for (const Keywords& restriction : call.factors("RESTREINT")) restrict_to_part(restriction, *product);
  if (!call.reuse) return product;
  call.result->data = product;
  return nullptr;
}

}  // namespace comma::commands
