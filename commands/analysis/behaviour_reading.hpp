// COMPORTEMENT in the solver's words (U4.51.11).
#pragma once

#include <memory>

#include "interpreter/graph/call.hpp"
#include "solver/model/behaviour.hpp"
#include "solver/model/model.hpp"

namespace comma::commands {

/// One behaviour a cell by the occurrences of COMPORTEMENT, the later winning; null where all are linear. Throws
/// DiagnosticError `unsupported` for a relation that does not go with DEFORMATION='GROT_GDEP' of continua.
std::shared_ptr<const solver::BehaviourOfCells> behaviours_of(const interpreter::Keywords& keywords,
                                                              const solver::Model& model, bool from_initial_state);

}  // namespace comma::commands
