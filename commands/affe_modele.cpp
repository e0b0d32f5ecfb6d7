#include <map>

#include "commands/commands.hpp"
#include "commands/selection.hpp"

namespace comma::commands {

namespace {

using solver::Formulation;

// MODELISATION (U4.41.01) in the solver's words.
const std::map<std::string, Formulation, std::less<>>& formulations() {
  static const std::map<std::string, Formulation, std::less<>> table = {
      {"D_PLAN", Formulation::plane_strain},
      {"C_PLAN", Formulation::plane_stress},
      {"2D_DIS_T", Formulation::spring_2d},
  };
  return table;
}

bool is_plane(Formulation formulation) {
  return formulation == Formulation::plane_strain || formulation == Formulation::plane_stress;
}

// A later AFFE wins; TOUT and groups alike reach cells that a formulation has no element for, which then stay empty.
bool has_element(Formulation formulation, solver::CellType type) {
  const int dimension = solver::dimension(type);
  if (is_plane(formulation)) return dimension == 1 || dimension == 2;
  return dimension == 0 || type == solver::CellType::seg2;
}

}  // namespace

Product affe_modele(const Call& call, Context&) {
  auto model = std::make_shared<solver::Model>();
  model->mesh = call.data<MeshConcept>("MAILLAGE").mesh;
  const solver::Mesh& mesh = *model->mesh;
  model->formulations.assign(static_cast<std::size_t>(mesh.cell_count()), Formulation::none);
  for (const Keywords& assignment : call.factors("AFFE")) {
    const Formulation formulation = formulations().at(assignment.texts("MODELISATION").front());
    int assigned = 0;
    for (const int cell : selected_cells(assignment, mesh)) {
      if (!has_element(formulation, mesh.cell_types[cell])) continue;
      model->formulations[cell] = formulation;
      ++assigned;
    }
    if (assigned == 0) {
      throw interpreter::DiagnosticError(
          "no-element", "AFFE_MODELE: none of these cells can carry " + assignment.texts("MODELISATION").front(),
          assignment.span, "name cells of the right dimension: faces for D_PLAN and C_PLAN, segments or points for 2D_DIS_T");
    }
  }
  auto product = std::make_shared<ModelConcept>();
  product->model = std::move(model);
  return product;
}

}  // namespace comma::commands
