// COMPORTEMENT in the solver's words (U4.51.11).
#pragma once

#include <memory>
#include <vector>

#include "interpreter/graph/call.hpp"
#include "solver/model/behaviour.hpp"
#include "solver/model/model.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// The cells of an occurrence of COMPORTEMENT: all where it names none.
std::vector<int> cells_of_behaviour(const interpreter::Keywords& occurrence, const solver::Mesh& mesh);

/// One behaviour a cell by the occurrences of COMPORTEMENT, the later winning; null where all are linear. From an
/// initial state elasticity adds up, but for solids in small strains to which it gives no stresses: theirs are those of
/// the whole displacements (Code_Aster 17.3). So does that of Green and Lagrange's strains beside command variables,
/// whose change since the first instant counts there. Throws DiagnosticError `unsupported` for a relation that does not
/// go with DEFORMATION='GROT_GDEP' of continua.
std::shared_ptr<const solver::BehaviourOfCells> behaviours_of(const interpreter::Keywords& keywords,
                                                              const solver::Model& model,
                                                              const solver::InitialState* initial, bool has_variables);

}  // namespace comma::commands
