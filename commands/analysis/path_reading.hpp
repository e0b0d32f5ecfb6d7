// PILOTAGE in the solver's words, and what driven loads have been once a path has been followed.
#pragma once

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/nonlinear/iterations/path_control.hpp"

namespace comma::commands {

/// The factor PILOTAGE. Throws DiagnosticError `missing-keyword`, `unknown-component`, those of selections, and
/// `unsupported` beside CONTACT.
solver::PathControl path_control(const interpreter::Call& call, const solver::Mesh& mesh);

/// From now on the driven loads of a result are loads like others, with the intensities that its steps have found.
void settle_driven_loads(ResultConcept& result);

}  // namespace comma::commands
