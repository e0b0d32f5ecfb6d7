// What AFFE_CHAR_MECA, AFFE_CHAR_CINE and their kin with functions share (U4.44.01, U4.44.03).
//
// Values are numbers or, in the commands that end in _F, functions of X, Y, Z and INST; a function of anything else
// throws DiagnosticError `unknown-parameter`. Where one call loads the same place twice by one factor keyword, the
// later occurrence counts, component by component (U1.03.00, overloading).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::commands {

/// A model with its numbering, made once a call.
struct LoadedModel {
  explicit LoadedModel(const solver::Model& of) : model(of), mesh(*of.mesh), dofs(of) {}
  const solver::Model& model;
  const solver::Mesh& mesh;
  solver::DofMap dofs;
};

/// "zzzz237b.comm:66, DDL_IMPO": how messages name a condition.
solver::Origin origin_of(const interpreter::Keywords& keywords, const std::string& keyword);

/// What a keyword gives: a number, or the function that takes its place.
struct Amount {
  double value = 0.0;
  solver::FieldFunction function;

  double at(const solver::Point& place, double time) const { return function ? function(place, time) : value; }
};
/// 0 where the keyword is not given.
Amount amount_of(const interpreter::Keywords& keywords, const std::string& name);

struct NamedComponent {
  const char* keyword;
  solver::Component component;
};
/// DX ... DRZ and FX ... MZ.
extern const std::array<NamedComponent, 6> displacement_keywords;
extern const std::array<NamedComponent, 6> force_keywords;

/// The component that a text names. Throws DiagnosticError `unknown-component` at the keyword's value.
solver::Component component_named(const interpreter::Keywords& keywords, const std::string& keyword,
                                  const std::string& name);

/// The nodes among `nodes` that carry a component. A plane and a beam may share one group: a component that only some
/// of its nodes have is meant for those; one that none has is a mistake: DiagnosticError `unknown-component`.
std::vector<int> carriers(const interpreter::Keywords& keywords, const NamedComponent& named,
                          const std::vector<int>& nodes, const solver::DofMap& dofs);

/// What the nodal field CHAM_NO holds of the degrees of freedom of the model, zeros included. Throws DiagnosticError
/// `wrong-concept-type`, `incompatible-field`, `unknown-component`.
std::vector<solver::LinearRelation::Term> terms_of_field(const interpreter::Keywords& keywords,
                                                         const LoadedModel& target);

/// Axes (rows) of nautical angles in degrees, of which those missing are 0.
Eigen::Matrix3d axes_of_angles(const std::vector<double>& degrees);

/// Imposed displacements and rotations: DDL_IMPO or, with `alarms`, MECA_IMPO, where holding a component that no node
/// carries is an alarm and not an error (AFFE_CHAR_CINE passes over it). The others have keywords of their own.
void add_imposed_displacements(const interpreter::Keywords& keywords, const std::string& name,
                               const LoadedModel& target, solver::Load& load,
                               interpreter::Diagnostics* alarms = nullptr);
/// Whether the cell is a plate, not an edge of one.
bool is_plate(const LoadedModel& target, int cell);
/// Whether pressures act on the cell: skin of a body, or a plate.
bool is_surface(const LoadedModel& target, int cell);

/// Alarm `faces-meet` where the mean normal at a node is far from that of a face.
void add_face_displacements(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load,
                            interpreter::Diagnostics& alarms);
void add_edge_displacements(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load);
void add_beam_displacements(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load);
void add_oblique_displacements(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load);

/// CHAMNO_IMPO: the displacements of a field.
void add_displacements_of_field(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load);

/// LIAISON_...: relations between displacements.
void add_relations(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);

/// Forces that fields hold: VECT_ASSE, EVOL_CHAR.
void add_forces_of_fields(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);

/// Forces on nodes, skins, volumes, beams; weight, rotation, initial strains.
void add_forces(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);

/// EVOL_CHAR: pressures and forces that a result holds in time, linear between its instants.
void add_evolving_loads(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);

/// EVOL_IMPO: the displacements of a result imposed on the nodes that have them, linear between its instants.
void add_evolving_displacements(const interpreter::Keywords& call, const LoadedModel& target, solver::Load& load);

}  // namespace comma::commands
