// Section forces at the ends of beams that carry distributed loads (EFGE_ELNO; U4.81.04, R3.08.01).
#pragma once

#include <map>
#include <span>

#include <Eigen/Dense>

#include "solver/elements/external_forces.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// Own axes (rows) of the beams that have turned, by cell.
using TurnedAxes = std::map<int, Eigen::Matrix3d>;

/// Those of the beams that turn as far as they like (rotating_beam.hpp), from DEPL and VARI_ELGA. Where that is null
/// the first axes are right, and the others roll about them.
TurnedAxes turned_axes(const Model& model, const BehaviourOfCells& behaviours, const NodalField& displacement,
                       const ElementField* variables);

/// Section forces at element nodes (N VY VZ MT MFY MFZ as elements have them) out of SIEF_ELNO. In
/// beams under forces per length, weight or rotation the ends' displacements alone leave out what the load does between
/// them: its end forces are taken away, so that the free end of a loaded cantilever has none. The loads keep their
/// directions in space while beams turn: `turned` are the axes to which `at_nodes` refers where they are not the
/// initial ones. Throws what add_external_forces throws.
ElementField end_section_forces(const ForceInput& input, const ElementField& at_nodes,
                                std::span<const AppliedLoad> loads, double time, const TurnedAxes& turned = {});

}  // namespace comma::solver
