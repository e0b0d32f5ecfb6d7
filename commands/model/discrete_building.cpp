#include "commands/model/discrete_building.hpp"

#include <fmt/format.h>

#include <numbers>

#include "commands/model/angles.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/mesh/axes.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;
using solver::DiscreteFrame;
using solver::Formulation;

namespace {

bool is_plane(Formulation formulation) {
  return formulation == Formulation::spring_2d || formulation == Formulation::spring_rotation_2d;
}

bool turns(Formulation formulation) {
  return formulation == Formulation::spring_rotation_2d || formulation == Formulation::spring_rotation_3d;
}

bool has_own_axes(Formulation formulation) { return is_discrete(formulation) || is_beam(formulation); }

const char* modelisation(bool plane, bool rotations) {
  if (plane) return rotations ? "2D_DIS_TR" : "2D_DIS_T";
  return rotations ? "DIS_TR" : "DIS_T";
}

// CARA reads MATRIX_COMPONENTS[_D]_SUPPORT (U4.42.01): K_TR_D_L is a diagonal stiffness with rotations on a segment.
struct Characteristic {
  explicit Characteristic(const std::string& word)
      : name(word),
        quantity(word.front()),
        rotations(word.substr(1).starts_with("_TR")),
        diagonal(word.find("_D_") != std::string::npos),
        segment(word.back() == 'L') {}
  std::string name;
  char quantity;  ///< K: stiffness, M: mass, A: damping
  bool rotations;
  bool diagonal;
  bool segment;
};

void check_element(const Keywords& assignment, const std::string& name, const Characteristic& wanted,
                   const solver::Model& model, int cell) {
  const Formulation formulation = model.formulations[cell];
  const bool plane = name == "DISCRET_2D";
  const char* needed = modelisation(plane, wanted.rotations);
  if (!is_discrete(formulation) || is_plane(formulation) != plane || turns(formulation) != wanted.rotations) {
    throw DiagnosticError("not-discrete",
                          fmt::format("{}: {} belongs to elements {}, and cell {} carries none", name, wanted.name,
                                      needed, model.mesh->cell_name(cell)),
                          assignment.span,
                          is_discrete(formulation) && is_plane(formulation) != plane
                              ? fmt::format("the cell lies in a {} model: take {}", plane ? "spatial" : "plane",
                                            plane ? "DISCRET" : "DISCRET_2D")
                              : fmt::format("give it MODELISATION=\"{}\" in AFFE_MODELE", needed));
  }
  const bool on_segment = model.mesh->cell_types[cell] == solver::CellType::seg2;
  if (wanted.segment == on_segment) return;
  throw DiagnosticError(
      "wrong-support",
      fmt::format("{}: {} stands on a {}, but cell {} is a {}", name, wanted.name, wanted.segment ? "segment" : "point",
                  model.mesh->cell_name(cell), solver::name_of(model.mesh->cell_types[cell])),
      assignment.span_of("CARA"), "the last letter of CARA is L on segments, N on points");
}

void check_symmetry(const Keywords& assignment, const std::string& name, const Characteristic& wanted) {
  if (!wanted.diagonal || assignment.text("SYME") == "OUI") return;
  throw DiagnosticError("wrong-combination",
                        fmt::format("{}: {} is diagonal, so SYME=\"NON\" has no meaning", name, wanted.name),
                        assignment.span_of("SYME"), "leave out SYME, or give all terms of a full matrix");
}

// The values of a rigid body (U4.42.01): its mass, then its inertia, then where it lies.
solver::DiscreteInertia inertia_of(const Keywords& assignment, const Characteristic& wanted, bool plane) {
  const auto values = assignment.reals("VALE");
  const std::size_t inertias = !wanted.rotations ? 0 : plane ? 1 : wanted.segment ? 3 : 6;
  const std::size_t offsets = !wanted.rotations || wanted.segment ? 0 : plane ? 2 : 3;
  if (values.size() != 1 + inertias + offsets) {
    throw DiagnosticError("wrong-size",
                          fmt::format("{} takes {} values, not {}", wanted.name, 1 + inertias + offsets, values.size()),
                          assignment.span_of("VALE"));
  }
  solver::DiscreteInertia inertia;
  inertia.mass = values[0];
  if (plane && inertias == 1) inertia.tensor(2, 2) = values[1];
  if (!plane && inertias >= 3) inertia.tensor.diagonal() << values[1], values[2], values[3];
  if (inertias == 6) {  // Ixy, Iyz, Ixz
    inertia.tensor(0, 1) = inertia.tensor(1, 0) = values[4];
    inertia.tensor(1, 2) = inertia.tensor(2, 1) = values[5];
    inertia.tensor(0, 2) = inertia.tensor(2, 0) = values[6];
  }
  for (std::size_t i = 0; i < offsets; ++i) inertia.offset[static_cast<Eigen::Index>(i)] = values[1 + inertias + i];
  return inertia;
}

void assign(const Keywords& assignment, const Characteristic& wanted, const solver::Model& model, int cell,
            const solver::Orientation& orientation, solver::ElementProperties& properties) {
  const auto frame = assignment.text("REPERE") == "LOCAL" ? DiscreteFrame::local : DiscreteFrame::global;
  const solver::Mesh& mesh = *model.mesh;
  const Formulation formulation = model.formulations[cell];
  const auto values = assignment.reals("VALE");
  const bool all_terms = assignment.text("SYME") == "NON";
  if (wanted.quantity != 'M') {
    const auto make = wanted.diagonal ? solver::diagonal_stiffness
                      : all_terms     ? solver::unsymmetric_stiffness
                                      : solver::symmetric_stiffness;
    // A damping matrix has as many terms; it is checked, and does nothing in statics.
    solver::DiscreteStiffness matrix = make(mesh, cell, formulation, values, frame, orientation);
    if (wanted.quantity == 'K') properties.discrete[cell] = std::move(matrix);
  } else if (wanted.diagonal) {
    properties.masses[cell] = solver::rigid_mass(
        mesh, cell, formulation, inertia_of(assignment, wanted, is_plane(formulation)), frame, orientation);
  } else {
    const auto make = all_terms ? solver::unsymmetric_mass : solver::symmetric_mass;
    properties.masses[cell] = make(mesh, cell, formulation, values, frame, orientation);
  }
  if (wanted.quantity == 'K') return;
  // What is not given is zero (U4.42.01).
  const std::vector<double> none(static_cast<std::size_t>(solver::discrete_components(formulation)), 0.0);
  properties.discrete.try_emplace(cell, solver::diagonal_stiffness(mesh, cell, formulation, none, frame, orientation));
}

void check_count(const Keywords& assignment, std::size_t least, std::size_t most) {
  const std::size_t given = assignment.reals("VALE").size();
  if (given >= least && given <= most) return;
  const std::string wanted = least == most ? std::to_string(most) : fmt::format("{} to {}", least, most);
  throw DiagnosticError("wrong-count",
                        fmt::format("ORIENTATION: {} takes {} values, not {}", assignment.text("CARA"), wanted, given),
                        assignment.span_of("VALE"));
}

Eigen::Vector3d vector_at(const std::vector<double>& values, std::size_t first) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3 && first + i < values.size(); ++i)
    vector[static_cast<Eigen::Index>(i)] = values[first + i];
  return vector;
}

// ANGL_VRIL and VECT_Y turn what has a direction of its own, ANGL_NAUT and VECT_X_Y what has none.
void orient(const Keywords& assignment, const solver::Mesh& mesh, int cell, solver::Orientation& orientation) {
  const std::string& kind = assignment.text("CARA");
  const bool of_segments = kind == "ANGL_VRIL" || kind == "VECT_Y";
  if (assignment.has("PRECISION")) orientation.no_length = assignment.real("PRECISION");
  if (of_segments != solver::has_direction(mesh, cell, orientation.no_length)) {
    throw DiagnosticError(
        "wrong-support",
        fmt::format("ORIENTATION: {} turns {}, and cell {} is {}", kind, of_segments ? "segments" : "points",
                    mesh.cell_name(cell), of_segments ? "none that has a length" : "a segment"),
        assignment.span_of("CARA"), of_segments ? "use ANGL_NAUT or VECT_X_Y" : "use ANGL_VRIL or VECT_Y");
  }
  const auto values = assignment.reals("VALE");
  if (kind == "ANGL_VRIL") {
    check_count(assignment, 1, 1);
    orientation.roll = values[0] * degree;
  } else if (kind == "VECT_Y") {
    check_count(assignment, 2, 3);
    orientation.roll = solver::roll_towards(mesh, cell, vector_at(values, 0));
  } else if (kind == "ANGL_NAUT") {
    check_count(assignment, 1, 3);
    const Eigen::Vector3d angles = vector_at(values, 0) * degree;
    orientation.point_axes = solver::nautical_axes(angles[0], angles[1], angles[2]);
  } else {
    check_count(assignment, 6, 6);
    orientation.point_axes = solver::axes_along(vector_at(values, 0), vector_at(values, 3));
  }
}

}  // namespace

void add_orientations(const Keywords& assignment, const solver::Model& model, Orientations& orientations) {
  bool any = false;
  for (const int cell : selected_cells(assignment, *model.mesh)) {
    if (!has_own_axes(model.formulations[cell])) continue;
    any = true;
    try {
      orient(assignment, *model.mesh, cell, orientations[cell]);
    } catch (const solver::Error& error) {
      throw DiagnosticError(error.code(), std::string("ORIENTATION: ") + error.what(), assignment.span_of("VALE"),
                            error.hint());
    }
  }
  if (any) return;
  throw DiagnosticError("no-element", "ORIENTATION: none of these cells is a beam or a discrete element",
                        assignment.span, "only their axes are turned here; those of solids are by MASSIF");
}

void add_discrete_matrices(const Keywords& assignment, const std::string& name, const solver::Model& model,
                           const Orientations& orientations, solver::ElementProperties& properties) {
  const Characteristic wanted(assignment.text("CARA"));
  check_symmetry(assignment, name, wanted);
  for (const int cell : selected_cells(assignment, *model.mesh)) {
    check_element(assignment, name, wanted, model, cell);
    const auto turned = orientations.find(cell);
    try {
      assign(assignment, wanted, model, cell, turned == orientations.end() ? solver::Orientation() : turned->second,
             properties);
    } catch (const solver::Error& error) {
      throw DiagnosticError(error.code(), name + ": " + error.what(), assignment.span_of("VALE"), error.hint());
    }
  }
}

}  // namespace comma::commands
