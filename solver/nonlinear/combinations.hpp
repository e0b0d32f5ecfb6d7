// What does not go together in a nonlinear computation.
#pragma once

#include "solver/elements/assembler.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/nonlinear/steps/step_sequence.hpp"

namespace comma::solver {

/// Of bodies, conditions, loads and methods. `links_turn`: rigid bodies of nodes are in large rotations. Throws Error
/// `unsupported`, and what require_modes throws.
void require_known_combination(const StaticProblem& problem, const NewtonOptions& options, const Assembler& assembler,
                               bool links_turn);

/// Of what a plan watches on the way with what there is to watch. Throws Error `unsupported`, `contradictory-keywords`.
void require_watchable(const StepPlan& plan, const StaticProblem& problem, const NewtonOptions& options);

}  // namespace comma::solver
