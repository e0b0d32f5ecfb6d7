// Whether something carries the surfaces of contact.
#pragma once

#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// Throws Error `floating-surface` naming a facet of a contact surface and a node of it that no element with stiffness
/// reaches and that no condition moves: contact would push it before itself as if nothing were there.
void require_carried_surfaces(const StaticProblem& problem);

}  // namespace comma::solver
