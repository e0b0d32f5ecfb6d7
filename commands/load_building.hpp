// What the load commands share: conditions and forces on the nodes that keywords name.
#pragma once

#include <string>
#include <vector>

#include "interpreter/call.hpp"
#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::commands {

/// A model with its numbering, made once a call.
struct LoadedModel {
  explicit LoadedModel(const solver::Model& of) : model(of), dofs(of) {}
  const solver::Model& model;
  solver::DofMap dofs;
};

/// "zzzz237b.comm:66, DDL_IMPO": how messages name a condition.
solver::Origin origin_of(const interpreter::Keywords& keywords, const std::string& keyword);

/// Values are numbers or, in the commands that end in _F, functions of X, Y, Z and INST; a function of anything else throws
/// DiagnosticError `unknown-parameter`.

/// Adds u(node, component) = value for each component keyword given (DX, DY ... DRZ) on each node that carries it.
/// Throws DiagnosticError `unknown-component` at a component that none of the nodes carries.
void add_imposed_displacements(const interpreter::Keywords& keywords, const std::string& name, const LoadedModel& target,
                               solver::Load& load);

/// Adds nodal forces for FX, FY, FZ, MX, MY, MZ; throws as above.
void add_nodal_forces(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load);

/// Adds pressures on the skin cells named; throws DiagnosticError `no-skin` when none of them is a skin of the model.
void add_pressures(const interpreter::Keywords& keywords, const LoadedModel& target, solver::Load& load);

}  // namespace comma::commands
