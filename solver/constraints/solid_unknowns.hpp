// Where the unknowns of a solid lie: what multigrid needs to know beyond the matrix.
#pragma once

#include <memory>

#include "solver/constraints/elimination.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The nodes and places of the reduced unknowns; null unless the model is one solid: fully integrated cells of three
/// dimensions alone, each joined to the rest over whole faces. Such a body has no motions without energy other than
/// rigid ones, for a cell has none and a common face ties two cells; so a method that sees no pivots is safe once the
/// rigid motions are known to be held.
std::shared_ptr<const SolidUnknowns> solid_unknowns(const Model& model, const DofMap& dofs,
                                                    const Elimination& elimination);

}  // namespace comma::solver
