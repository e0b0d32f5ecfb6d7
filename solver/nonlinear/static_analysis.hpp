// Quasi-static analysis by Newton's method, with contact and unilateral conditions.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/contact/definition.hpp"
#include "solver/contact/doubts.hpp"
#include "solver/elements/slender/section.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/loads/load.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/behaviour.hpp"
#include "solver/model/model.hpp"
#include "solver/nonlinear/iterations/path_control.hpp"
#include "solver/nonlinear/stability_analysis.hpp"
#include "solver/nonlinear/steps/step_sequence.hpp"

namespace comma::solver {

/// Work counters, as in the JSON report, and the seconds spent on the parts of a solution.
struct Counters {
  long factorisations = 0;
  long indefinite_factorisations = 0;  ///< of a reduced tangent that is not positive definite
  long indefinite_solutions = 0;       ///< accepted ones, with such a tangent
  long solves = 0;
  long newton_iterations = 0;
  long contact_iterations = 0;
  long pairings = 0;
  double assembling = 0.0;   ///< s: pattern, element matrices and their reduction
  double factorising = 0.0;  ///< s: analysis and factor, or the grids of multigrid
  double solving = 0.0;      ///< s: right-hand sides, refinement
};

/// Where a computation starts instead of undisplaced and without stress. What is not given is zero.
struct InitialState {
  std::optional<NodalField> displacement;
  std::optional<ElementField> stresses;   ///< as SIEF_ELGA
  std::optional<ElementField> variables;  ///< as VARI_ELGA
  /// From which differential loads count; absent: from `displacement`.
  std::optional<NodalField> differential_reference;
  std::vector<AppliedLoad> loads;     ///< that led there: initial strains count from theirs
  std::optional<NodalField> earlier;  ///< the displacement a step before, which gives a path its direction
  std::optional<double> intensity;    ///< of driven loads; absent: 0
  std::shared_ptr<const ContactMemory> contact = {};  ///< of the step that it is; null: contact begins anew
  std::map<std::string, Field> contact_fields = {};  ///< that the step holds of the same surfaces: CONT_NOEU, CONT_ELEM
};

struct StaticProblem {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MaterialField> materials;
  std::shared_ptr<const ElementProperties> properties;  ///< never null, may be empty
  std::vector<AppliedLoad> loads;                       ///< on the initial geometry
  std::vector<AppliedLoad> followers;                   ///< on the deformed one: see follower_forces.hpp
  std::vector<RigidLink> turning_links;  ///< rigid bodies of nodes in large rotations: see turning_links.hpp
  std::vector<AppliedLoad> driven;  ///< on the initial geometry, times the intensity that NewtonOptions::path finds
  std::vector<UnilateralCondition> unilateral;
  std::optional<ContactDefinition> contact;
  std::shared_ptr<const BehaviourOfCells> behaviours;  ///< null: linear elasticity in small strains everywhere
  std::shared_ptr<const InitialState> initial;         ///< null: at rest, or where the result that goes on left off
};

enum class TangentKind : std::uint8_t {
  tangent,   ///< of what the material does
  starting,  ///< the same where a step starts (Assembler::starting_stiffness)
  elastic,   ///< ELASTIQUE (Assembler::initial_stiffness)
  unloading  ///< as if it could only answer elastically from where it is
};

/// Which one the first iteration takes, nothing having moved yet.
constexpr TangentKind at_start(TangentKind prediction) {
  return prediction == TangentKind::tangent ? TangentKind::starting : prediction;
}

/// When the stiffness of nonlinear bodies is made again, and which one (U4.51.03, NEWTON). It changes the way to the
/// solution alone.
struct TangentPolicy {
  TangentKind prediction = TangentKind::tangent;  ///< of the first iteration of a step
  TangentKind correction = TangentKind::tangent;  ///< of the others
  int steps = 1;               ///< REAC_INCR: made again for the first iteration of so many steps; 0: never
  int iterations = 1;          ///< REAC_ITER: and after so many iterations within a step; 0: never
  double elastic_below = 0.0;  ///< s, PAS_MINI_ELAS: shorter steps take the elastic stiffness ...
  int elastic_iterations = 0;  ///< ... and REAC_ITER_ELAS in place of REAC_ITER
};

/// How far to go along a correction d of Newton's method (R5.03.01, RECH_LINEAIRE): where the work of the residual on
/// d, g(rho) = d . R(u + rho d), has fallen below a share of g(0). It takes no part in the first iteration of a step.
/// By CORDE along secants through the last two trials. By MIXTE three times as far until the work changes sign, then
/// along such secants too where they stay between the places where the sign differs, and, where the sign has just
/// changed, in the half of the last trial; else in the middle (rho of Code_Aster 17.3, trial by trial).
struct LineSearch {
  bool bracketed = false;  ///< MIXTE; else CORDE
  double tolerance = 0.1;  ///< RESI_LINE_RELA
  int max_iterations = 3;  ///< ITER_LINE_MAXI
  double smallest = 1e-2;  ///< RHO_MIN
  double largest = 10.0;   ///< RHO_MAX
  double excluded = 9e-3;  ///< RHO_EXCL: no |rho| below
};

/// What the first iteration of a step starts from.
enum class StepGuess : std::uint8_t {
  stay,        ///< the step before, and a prediction by the tangent
  extrapolate  ///< where the displacements go if they keep their speed (EXTRAPOLE)
};

/// Stresses and resultants of the size that a user expects, of which reference forces are made (R5.03.01,
/// RESI_REFE_RELA).
struct ReferenceEfforts {
  double stress = 0.0;  ///< SIGM_REFE, of continua
  double force = 0.0;   ///< EFFORT_REFE, of bars, beams, springs and, a length, of plates
  double moment = 0.0;  ///< MOMENT_REFE, of beams, springs and, a length, of plates
  double strain = 0.0;  ///< EPSI_REFE, where the pressure is an unknown
};

/// What of the stresses that a step is to start from counts for nothing: all of them, where laws take those that the
/// rest of the initial state makes, or their mean, where an element has it from the change of volume.
enum class UnusedStresses : std::uint8_t { all, mean };

struct NewtonOptions {
  std::optional<double> relative_residual = 1e-6;  ///< RESI_GLOB_RELA
  std::optional<double> absolute_residual;         ///< RESI_GLOB_MAXI
  std::optional<double> referred_residual;         ///< RESI_REFE_RELA: against forces that the reference efforts make
  /// RESI_COMP_RELA: component by component, against the internal forces where the step began.
  std::optional<double> component_residual;
  ReferenceEfforts reference;
  bool one_criterion = false;                    ///< where both are given, one of them is enough (VERIF='AU_MOINS_UN')
  int max_iterations = 10;                       ///< ITER_GLOB_MAXI
  std::function<void(double)> note_unconverged;  ///< set: steps that do not converge within those iterations stand all
                                                 ///< the same, and are told here by their instant (ARRET='NON')
  std::function<void(int, UnusedStresses)> note_unused_stresses;  ///< set: is told a cell where some have no effect
  /// ITER_GLOB_ELAS: of steps that are short enough to take the elastic stiffness instead.
  int max_elastic_iterations = 25;
  std::optional<LinearMethod> method;  ///< empty: chosen for the matrix
  LinearOptions linear;
  TangentPolicy tangent;
  std::optional<LineSearch> line_search;  ///< for problems without contact and unilateral conditions
  StepGuess guess = StepGuess::stay;
  std::shared_ptr<const Result> guessed;  ///< not null: instead, steps start from the displacements of this result at
                                          ///< their instants, linear between its steps (DEPL_CALCULE)
  bool extrapolates_flow = false;  ///< steps are linear, with plastic strains that go on growing as in the step before,
                                   ///< which the law then puts right (IMPLEX, R5.03.81)
  std::optional<StabilityAnalysis> stability;  ///< of the steps that converge
  std::optional<PathControl> path;             ///< the intensity of driven loads is an unknown
  bool few_solutions = false;  ///< the tangent serves few right-hand sides: a method without a factor may be faster
};

/// One line of the live table.
struct IterationReport {
  double instant = 0.0;
  int iteration = 0;
  double relative_residual = 0.0;
  double absolute_residual = 0.0;
  std::string worst;  ///< "DY at N12": where the residual is largest
  int active_conditions = 0;
  int contact_changes = 0;
  /// How deep contact and unilateral conditions are passed at worst (a length, as a rule).
  std::optional<double> penetration;
  std::string event;   ///< not empty: no iteration, but what happened to the step ("step to 1 fails ...")
  std::string detail;  ///< of an event: more of it, for those who want to know
};

/// A line that tells what happened to the step to an instant.
inline IterationReport event_of_step(double instant, std::string text, std::string detail = {}) {
  IterationReport report;
  report.instant = instant;
  report.event = std::move(text);
  report.detail = std::move(detail);
  return report;
}

/// Called after each Newton iteration and when a step is cut; may be empty.
using IterationObserver = std::function<void(const IterationReport&)>;

/// Called when a step has been appended to the result, the initial state included; may be empty. It may change what the
/// result keeps of the steps, but must leave the last one at its end.
using StepObserver = std::function<void(Result& result)>;

/// Throws what solve_static() can tell before it solves: what does not go together, materials, sections and elements
/// that are missing, contradictory conditions.
void require_solvable(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options);

/// Solves the steps of the plan (its first instant is the initial state, archived as order 0) and appends each
/// converged one to `result`: DEPL, SIEF_ELGA, VARI_ELGA (one zero where materials have no memory), CONT_NOEU with
/// contact, and the parameter ETA_PILOTAGE where the intensity of loads is an unknown (whose last step is the one that
/// reaches a bound). Steps already appended stay when it throws. A pressure that follows the body makes the tangent
/// unsymmetric; with contact or unilateral conditions its symmetric half is taken. Errors: `integration-failure` (the
/// law at a point), `no-convergence` (residual history, worst node and component, likely cause), `singular-matrix`
/// (nodes, components, the rigid motion that nothing holds, what would hold it), `contradictory-conditions`,
/// `contact-cycling`; of the plan's events `residual-diverges`, `residual-too-large`, `increment-too-large`,
/// `contact-too-deep`, `contact-changes`, where steps may not be cut (any more). Returns what may be wrong with the
/// contact of the solution although its equations are solved.
ContactDoubts solve_static(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options,
                           Result& result, Counters& counters, const IterationObserver& observer = {},
                           const StepObserver& after_step = {});

}  // namespace comma::solver
