#include "commands/commands.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using solver::CellType;
using solver::Formulation;

bool is_discrete(Formulation formulation) {
  return formulation == Formulation::spring_2d || formulation == Formulation::spring_rotation_2d ||
         formulation == Formulation::spring_3d || formulation == Formulation::spring_rotation_3d;
}

// CARA names the support by its last letter (U4.42.01): ..._L lies on a segment, ..._N on a point.
void check_support(const Keywords& assignment, const solver::Model& model, int cell) {
  const std::string kind = assignment.texts("CARA").front();
  const bool segment = kind.back() == 'L';
  if (!is_discrete(model.formulations[cell])) {
    throw DiagnosticError("not-discrete", "DISCRET_2D: cell " + model.mesh->cell_name(cell) + " carries no discrete element",
                          assignment.span, "give it MODELISATION=\"2D_DIS_T\" in AFFE_MODELE");
  }
  if (segment != (model.mesh->cell_types[cell] == CellType::seg2)) {
    throw DiagnosticError("wrong-support", "DISCRET_2D: " + kind + " stands on a " + (segment ? "segment" : "point") + ", but cell " +
                                               model.mesh->cell_name(cell) + " is a " +
                                               std::string(solver::name_of(model.mesh->cell_types[cell])),
                          assignment.span_of("CARA"), segment ? "use K_T_D_N on points" : "use K_T_D_L on segments");
  }
}

void assign(const Keywords& assignment, const solver::Model& model, solver::ElementProperties& properties) {
  const auto frame = assignment.text("REPERE") == "LOCAL" ? solver::DiscreteFrame::local : solver::DiscreteFrame::global;
  const auto values = assignment.reals("VALE");
  for (const int cell : selected_cells(assignment, *model.mesh)) {
    check_support(assignment, model, cell);
    try {
      properties.discrete[cell] = solver::diagonal_stiffness(*model.mesh, cell, model.formulations[cell], values, frame);
    } catch (const solver::Error& error) {
      throw DiagnosticError(error.code(), std::string("DISCRET_2D: ") + error.what(), assignment.span_of("VALE"), error.hint());
    }
  }
}

}  // namespace

Product affe_cara_elem(const Call& call, Context&) {
  const solver::Model& model = *call.data<ModelConcept>("MODELE").model;
  auto properties = std::make_shared<solver::ElementProperties>();
  for (const Keywords& assignment : call.factors("DISCRET_2D")) assign(assignment, model, *properties);
  auto product = std::make_shared<PropertiesConcept>();
  product->properties = std::move(properties);
  return product;
}

}  // namespace comma::commands
