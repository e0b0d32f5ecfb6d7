// What the commands that solve tell about a scene before they solve it: data that is missing, that nothing takes, or
// that is likely not to be what is meant.
#pragma once

#include <set>

#include "commands/context.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// Alarms `near-incompressible` (cells that lock), `no-density` (weight or rotation of a material without one),
/// `no-expansion` (nothing depends on a temperature or drying that is given), `other-model` (a load, contact or
/// properties that were made on a model of other elements).
void warn_of_scene(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);

/// Of POST_ELEM: alarm `no-density` where cells whose masses are asked for have a material without one.
void warn_of_missing_masses(const interpreter::Call& call, const solver::StaticProblem& problem,
                            const std::set<int>& cells, Context& context);

/// Of MECA_STATIQUE, which computes `instant` where the file names none: alarm `no-load` where functions of time make
/// all loads vanish there.
void warn_of_loads_at_the_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant,
                                Context& context);

/// The same as warn_of_scene(), and of STAT_NON_LINE: `no-behaviour` (cells that COMPORTEMENT leaves out), `small-bars`
/// (bars that GROT_GDEP leaves in small displacements), and what warn_of_start() tells.
void warn_of_nonlinear_scene(const interpreter::Call& call, const solver::StaticProblem& problem, double first_instant,
                             const solver::BehaviourOfCells* before, Context& context);

}  // namespace comma::commands
