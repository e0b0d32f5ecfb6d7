// What the commands that solve tell about a solution that may be far from that of the body although the equations were
// solved.
#pragma once

#include <set>

#include "commands/concepts.hpp"
#include "commands/context.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// Alarm `indefinite-stiffness`, if a solution since `counters_before` stands where the stiffness is not positive
/// definite.
void warn_of_indefinite_stiffness(const interpreter::Call& call, const solver::Counters& counters_before,
                                  Context& context);

/// Alarms `soft-penalty`, `soft-friction-penalty`, `held-overlap`, `coarse-slave`, `weak-friction` and others on what
/// may be wrong with the contact and the bounds of a solution.
void warn_of_contact(const interpreter::Call& call, const solver::StaticProblem& problem,
                     const solver::ContactDoubts& doubts, Context& context);

/// Alarm `steps-used-up`: steps that adapt end before the last instant of the list, at the most that are allowed
/// (NB_PAS_MAXI).
void warn_of_used_up_steps(const interpreter::Call& call, const solver::StepPlan& plan, const ResultConcept& product,
                           Context& context);

/// Alarm `not-converged`: steps that stand all the same (ARRET='NON'), by their instants.
void warn_of_unconverged_steps(const interpreter::Call& call, const std::set<double>& instants, Context& context);

/// Alarm `unused-stresses`: what ETAT_INIT gives as SIGM is not what its other fields make of the stresses, of a law
/// that takes these, or its mean not their pressure, of an element that takes this.
void warn_of_unused_stresses(const interpreter::Call& call, const solver::StaticProblem& problem, int cell,
                             solver::UnusedStresses unused, Context& context);

/// Alarm `coarse-turns`, where beams in large rotations have turned so far in their steps that they are longer for it.
void warn_of_turns(const interpreter::Call& call, const ResultConcept& product, Context& context);

/// Alarm `inside-out`: a cell that GREEN_LAGRANGE lets through itself, by the first instant. `from`: that of the first
/// step that the command has computed.
void warn_of_inverted_cells(const interpreter::Call& call, const ResultConcept& product, double from, Context& context);

}  // namespace comma::commands
