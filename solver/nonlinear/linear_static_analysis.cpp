#include "solver/nonlinear/linear_static_analysis.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "solver/constraints/elimination.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"

namespace comma::solver {
namespace {

/// Corrections after the first solution, at most: each gains the digits that the factorisation has to give.
constexpr int max_corrections = 3;
/// A correction below this share of the solution is rounding.
constexpr double negligible_correction = 4e-16;

NewtonOptions tangent_options(const LinearStaticOptions& options, std::size_t solutions) {
  NewtonOptions result;
  result.few_solutions = solutions <= TangentSystem::few_solutions;
  result.method = options.method;
  result.linear = options.linear;
  return result;
}

class LinearStaticAnalysis {
 public:
  LinearStaticAnalysis(const StaticProblem& problem, const LinearStaticOptions& options, std::size_t solutions,
                       Counters& counters)
      : problem_(problem),
        dofs_(*problem.model),
        assembler_(*problem.model, *problem.materials, *problem.properties, dofs_),
        elimination_(*problem.model->mesh, dofs_, problem.loads),
        tangent_options_(tangent_options(options, solutions)),
        tangent_(*problem.model, dofs_, assembler_, elimination_, tangent_options_, counters),
        counters_(counters) {}

  Eigen::VectorXd solve(double time) {
    assembler_.set_time(time);
    assembler_.impose_strains(problem_.loads, time);
    const Eigen::VectorXd offset = elimination_.offset(time);
    const Eigen::VectorXd external = assembler_.external_forces(problem_.loads, time);
    tangent_.refresh(offset);
    // The linear solver refines its solution to the last digits. What it cannot see is the rounding of forces that
    // large imposed displacements cause, which a body held by weak springs feels: corrections remove that.
    // Where there is no factor the scene is one solid without springs, and a solution costs as much as the first.
    const int corrections = largest_component(offset) > 0.0 && tangent_.has_factor() ? max_corrections : 0;
    Eigen::VectorXd reduced = Eigen::VectorXd::Zero(elimination_.reduced_size());
    Eigen::VectorXd u = offset;
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= corrections; ++k) {
      Eigen::MatrixXd step = elimination_.transformation().transpose() * (external - assembler_.internal_forces(u));
      tangent_.solve(step);
      reduced += step;
      u = elimination_.transformation() * reduced + offset;
      const double share =
          largest_component(step) / std::max(largest_component(reduced), std::numeric_limits<double>::min());
      if (share <= negligible_correction || (k > 0 && share > 0.5 * last)) break;
      last = share;
    }
    if (tangent_options_.linear.singular_digits < 0) require_equilibrium(external, u);
    if (tangent_.is_indefinite()) ++counters_.indefinite_solutions;
    return u;
  }

  /// Where null pivots are not tested, a body that nothing holds moves as far as rounding lets it, and out of balance.
  void require_equilibrium(const Eigen::VectorXd& external, const Eigen::VectorXd& u) const {
    constexpr double worst_imbalance = 1e-6;  // what Code_Aster allows solutions by default (RESI_RELA, U4.50.01)
    const Eigen::VectorXd internal = assembler_.internal_forces(u);
    const double imbalance = largest_component(elimination_.transformation().transpose() * (external - internal));
    const double forces = std::max(largest_component(external), largest_component(internal));
    if (imbalance <= worst_imbalance * forces) return;
    throw Error(
        "inaccurate-solution",
        fmt::format(
            "the nodes are out of balance by {:.1e} of the forces on them: the stiffness is singular or nearly so",
            imbalance / forces),
        "let null pivots be tested (NPREC=8, STOP_SINGULIER='OUI'), which tells what nothing holds");
  }

  ResultStep archive(double time, const Eigen::VectorXd& u, bool stresses) const {
    ResultStep step;
    step.instant = time;
    step.fields.emplace("DEPL", to_field(u, dofs_, "DEPL_R"));
    if (stresses) step.fields.emplace("SIEF_ELGA", assembler_.stresses(u, problem_.loads, time));
    return step;
  }

 private:
  const StaticProblem& problem_;
  DofMap dofs_;
  Assembler assembler_;
  Elimination elimination_;
  NewtonOptions tangent_options_;
  TangentSystem tangent_;
  Counters& counters_;
};

void refuse_conditions(const StaticProblem& problem) {
  if (!problem.contact && problem.unilateral.empty()) return;
  throw Error("unsupported", "linear statics takes neither contact nor unilateral conditions",
              "solve the problem as a nonlinear one");
}

}  // namespace

void require_solvable(const StaticProblem& problem, const LinearStaticOptions& options) {
  refuse_conditions(problem);
  Counters counters;
  const LinearStaticAnalysis analysis(problem, options, 1, counters);
}

void solve_linear_static(const StaticProblem& problem, std::span<const double> instants,
                         const LinearStaticOptions& options, Result& result, Counters& counters) {
  refuse_conditions(problem);
  LinearStaticAnalysis analysis(problem, options, instants.size(), counters);
  result.model = problem.model;
  for (const double time : instants) {
    ResultStep step = analysis.archive(time, analysis.solve(time), options.stresses);
    step.order = result.steps.empty() ? 1 : result.steps.back().order + 1;
    result.steps.push_back(std::move(step));
  }
}

}  // namespace comma::solver
