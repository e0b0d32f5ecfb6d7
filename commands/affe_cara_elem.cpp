#include <algorithm>
#include <numbers>

#include "commands/commands.hpp"
#include "commands/model/angles.hpp"
#include "commands/model/discrete_building.hpp"
#include "commands/model/plate_building.hpp"
#include "commands/model/section_building.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/mesh/axes.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// Angles in radians; those left out are 0.
Eigen::Vector3d angles_of(const Keywords& frame, const std::string& keyword) {
  return vector_of(frame, keyword) * degree;
}

// ORIG_AXE: round an axis through a point; alone, in the plane, the axis is Z.
Eigen::Matrix3d axes_round(const Keywords& frame, const solver::Model& model, int cell) {
  const Eigen::Vector3d along_z(0.0, -90.0 * degree, 0.0);
  const Eigen::Vector3d angles = frame.has("ANGL_AXE") ? angles_of(frame, "ANGL_AXE") : along_z;
  const Eigen::Vector3d origin = vector_of(frame, "ORIG_AXE");
  const Eigen::Matrix3d axes =
      solver::cylindrical_axes(angles[0], angles[1], origin, solver::centre_of(*model.mesh, cell));
  return solver::material_axes_round(
      axes, solver::continuum_dimension(model.formulations[static_cast<std::size_t>(cell)]) == 3);
}

// The axes of an anisotropic material in a cell.
Eigen::Matrix3d material_axes(const Keywords& frame, const solver::Model& model, int cell) {
  if (frame.has("ORIG_AXE")) return axes_round(frame, model, cell);
  const bool euler = frame.has("ANGL_EULER");
  const Eigen::Vector3d angles = angles_of(frame, euler ? "ANGL_EULER" : "ANGL_REP");
  return (euler ? solver::euler_axes : solver::nautical_axes)(angles[0], angles[1], angles[2]);
}

void add_material_axes(const Keywords& frame, const solver::Model& model, solver::ElementProperties& properties) {
  for (const int cell : selected_cells(frame, *model.mesh)) {
    if (solver::continuum_dimension(model.formulations[cell]) == 0) continue;
    try {
      properties.material_axes[cell] = material_axes(frame, model, cell);
    } catch (const solver::Error& error) {
      throw DiagnosticError(error.code(), std::string("MASSIF: ") + error.what(), frame.span, error.hint());
    }
  }
}

}  // namespace

Product affe_cara_elem(const Call& call, Context&) {
  const solver::Model& model = *call.data<ModelConcept>("MODELE").model;
  auto properties = std::make_shared<solver::ElementProperties>();
  auto product = std::make_shared<PropertiesConcept>();
  Orientations orientations;
  for (const Keywords& assignment : call.factors("ORIENTATION")) add_orientations(assignment, model, orientations);
  add_beam_sections(call.factors("POUTRE"), model, *properties);
  for (auto& [cell, section] : properties->sections) {
    if (const auto turned = orientations.find(cell); turned != orientations.end()) section.roll = turned->second.roll;
  }
  for (const Keywords& assignment : call.factors("BARRE")) add_bar_sections(assignment, model, *properties);
  for (const Keywords& assignment : call.factors("COQUE"))
    add_plate_sections(assignment, model, *properties, product->named_plates);
  for (const char* name : {"DISCRET", "DISCRET_2D"}) {
    for (const Keywords& assignment : call.factors(name))
      add_discrete_matrices(assignment, name, model, orientations, *properties);
  }
  for (const Keywords& frame : call.factors("MASSIF")) add_material_axes(frame, model, *properties);
  product->properties = std::move(properties);
  product->model = call.data<ModelConcept>("MODELE").model;
  return product;
}

}  // namespace comma::commands
