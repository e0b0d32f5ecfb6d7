// Matrices of discrete elements from DISCRET and DISCRET_2D of AFFE_CARA_ELEM, and the axes that ORIENTATION gives.
#pragma once

#include <unordered_map>

#include "interpreter/graph/call.hpp"
#include "solver/elements/slender/section.hpp"

namespace comma::commands {

using Orientations = std::unordered_map<int, solver::Orientation>;

/// ORIENTATION: the turning of the beams and discrete elements among the cells named. Throws DiagnosticError
/// `no-element` when there is none, `wrong-count` for VALE, `wrong-support` where CARA does not fit the cell,
/// `zero-vector`.
void add_orientations(const interpreter::Keywords& assignment, const solver::Model& model, Orientations& orientations);

/// `name` is DISCRET or DISCRET_2D. Throws DiagnosticError `not-discrete`, `wrong-support` or `wrong-size` where CARA
/// does not fit the element of a cell.
void add_discrete_matrices(const interpreter::Keywords& assignment, const std::string& name, const solver::Model& model,
                           const Orientations& orientations, solver::ElementProperties& properties);

}  // namespace comma::commands
