#include "commands/model/plate_building.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "commands/functions/functions.hpp"
#include "commands/loads/load_building.hpp"
#include "commands/model/angles.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/mesh/axes.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

// The direction whose part in the plane is the first axis of a plate.
Eigen::Vector3d direction_of(const Keywords& assignment) {
  if (assignment.given("VECTEUR")) {
    const auto values = assignment.reals("VECTEUR");
    const Eigen::Vector3d direction(values[0], values[1], values[2]);
    if (direction.isZero(0.0))
      throw DiagnosticError("zero-vector", "COQUE/VECTEUR has no length", assignment.span_of("VECTEUR"));
    return direction;
  }
  if (!assignment.given("ANGL_REP")) return Eigen::Vector3d::UnitX();
  const auto angles = assignment.reals("ANGL_REP");
  return solver::nautical_axes(angles[0] * degree, angles[1] * degree, 0.0).row(0).transpose();
}

// A section is made once, and stays.
void require_place_alone(const Keywords& assignment, const char* keyword) {
  if (!assignment.given(keyword) || !assignment.at(keyword).value.is_concept()) return;
  const interpreter::ConceptPtr& handle = assignment.concept_of(keyword);
  const auto parameters = interpreter::data_of<FunctionConcept>(handle, keyword).parameters();
  if (std::ranges::find(parameters, "INST") == parameters.end()) return;
  throw DiagnosticError(
      "unknown-parameter",
      fmt::format("COQUE/{}: {} depends on INST, and a section does not change in time", keyword, handle->name),
      assignment.span_of(keyword), "let it depend on the place: X, Y, Z");
}

}  // namespace

void add_plate_sections(const Keywords& assignment, const solver::Model& model, solver::ElementProperties& properties,
                        solver::PlateSections& named) {
  solver::PlateSection section;
  section.direction = direction_of(assignment);
  section.drilling = assignment.real("COEF_RIGI_DRZ");
  section.layers = static_cast<int>(assignment.integer("COQUE_NCOU"));
  for (const char* keyword : {"EPAIS_FO", "EXCENTREMENT_FO"}) require_place_alone(assignment, keyword);
  int assigned = 0;
  const Amount thickness = amount_of(assignment, assignment.given("EPAIS_FO") ? "EPAIS_FO" : "EPAIS");
  const Amount offset = amount_of(assignment, assignment.given("EXCENTREMENT_FO") ? "EXCENTREMENT_FO" : "EXCENTREMENT");
  for (const int cell : selected_cells(assignment, *model.mesh)) {
    const Eigen::Vector3d middle = solver::centre_of(*model.mesh, cell);
    section.thickness = thickness.at({middle[0], middle[1], middle[2]}, 0.0);
    section.offset = offset.at({middle[0], middle[1], middle[2]}, 0.0);
    named[cell] = section;
    if (!solver::is_plate(model.formulations[cell]) || model.is_skin(cell)) continue;
    properties.plates[cell] = section;
    ++assigned;
  }
  if (assigned == 0) {
    throw DiagnosticError("no-element", "COQUE: none of these cells is a plate", assignment.span,
                          "give them MODELISATION=\"DKT\" or \"DST\" in AFFE_MODELE");
  }
}

}  // namespace comma::commands
