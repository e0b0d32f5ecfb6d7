#include "solver/nonlinear/combinations.hpp"

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/nonlinear/critical_modes.hpp"

namespace comma::solver {
namespace {

bool has_conditions(const StaticProblem& problem) { return problem.contact || !problem.unilateral.empty(); }

/// Continua and bars alone know how.
void require_extrapolation(const StaticProblem& problem) {
  for (std::size_t cell = 0; problem.behaviours && cell < problem.behaviours->size(); ++cell) {
    const Formulation formulation = problem.model->formulations[cell];
    if (formulation == Formulation::none || continuum_dimension(formulation) > 0 || is_bar(formulation) ||
        (*problem.behaviours)[cell].relation == Relation::elastic)
      continue;
    throw Error("unsupported",
                fmt::format("cell {}: METHODE='IMPLEX' is known for continua and bars alone",
                            problem.model->mesh->cell_name(static_cast<int>(cell))),
                "take METHODE='NEWTON'");
  }
}

}  // namespace

void require_known_combination(const StaticProblem& problem, const NewtonOptions& options, const Assembler& assembler,
                               bool links_turn) {
  if (!assembler.has_symmetric_linear_part() && has_conditions(problem))
    throw Error(
        "unsupported",
        "contact and unilateral conditions need a symmetric stiffness, and here a spring has an unsymmetric one",
        "leave out the unsymmetric spring or the conditions");
  if (options.stability) require_modes(*options.stability, problem);
  if (links_turn && (has_conditions(problem) || options.path || options.stability))
    throw Error("unsupported",
                "rigid bodies in large rotations go with neither contact, unilateral conditions, path following nor "
                "modes of buckling",
                "leave out TYPE_CHARGE='SUIV' of LIAISON_SOLIDE where rotations are small");
  if (options.path && (has_conditions(problem) || !problem.followers.empty()))
    throw Error(
        "unsupported",
        "the intensity of loads is not sought together with contact, unilateral conditions or loads that follow",
        "leave out PILOTAGE, or the conditions");
  if (!options.extrapolates_flow) return;
  if (has_conditions(problem) || options.path)
    throw Error(
        "unsupported",
        "steps that extrapolate the plastic strain go with neither contact, unilateral conditions nor path following",
        "take METHODE='NEWTON'");
  require_extrapolation(problem);
}

void require_watchable(const StepPlan& plan, const StaticProblem& problem, const NewtonOptions& options) {
  const bool watches_residuals =
      plan.event(StepEventKind::divergence) || plan.event(StepEventKind::residual) || plan.further_iterations > 0.0;
  if (options.path && (watches_residuals || options.tangent.elastic_below > 0.0))
    throw Error("unsupported",
                "where the intensity of loads is sought, residuals are not watched on the way and steps take one kind "
                "of stiffness",
                "leave out DIVE_RESI, RESI_MAXI, ITER_SUPPL and PAS_MINI_ELAS");
  if (plan.event(StepEventKind::collision) && !has_conditions(problem))
    throw Error("contradictory-keywords", "nothing here can close or open, which is watched (EVENEMENT='COLLISION')",
                "give CONTACT, or leave out the event");
}

}  // namespace comma::solver
