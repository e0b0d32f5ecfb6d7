// What STAT_NON_LINE tells about the state that it starts from, before it solves anything.
#pragma once

#include "commands/context.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// Alarms `strained-start` (command variables strain the body at the first `instant` already, without an initial
/// state), and of what ETAT_INIT lacks `no-initial-field`, `partial-state`, `forgotten-flow`, `no-internal-variables`,
/// `released-points` (a contact with GLISSIERE goes on from fields), `other-volume` (a cell whose volume is elastic as
/// a whole goes on with another bulk modulus or expansion), `odd-variables` (more of them than the law has, or a
/// cumulated plastic strain below zero). `before`: the laws of the initial state; null: elasticity, or not known.
/// Throws DiagnosticError `other-variables` where a cell goes on from them with a law of other internal variables
/// (Code_Aster 17.3 stops as well).
void warn_of_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant,
                   const solver::BehaviourOfCells* before, Context& context);

}  // namespace comma::commands
