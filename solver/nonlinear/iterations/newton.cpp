#include "solver/nonlinear/iterations/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/iterations/line_search.hpp"

namespace comma::solver {
namespace {

/// A correction below this share of the solution is rounding.
constexpr double negligible_step = 4e-16;
/// A rigid body is one up to this share of its size.
constexpr double largest_violation = 1e-9;
/// Corrections after convergence, at most. Each gains the digits that the factorisation has to give: one is enough
/// where it has nearly all of them, two unless it has less than a third.
constexpr int max_polishing = 3;

}  // namespace

NewtonSolver::NewtonSolver(const Mesh& mesh, const DofMap& dofs, const Assembler& assembler,
                           const Elimination& elimination, const NewtonOptions& options, Counters& counters,
                           TangentSystem& tangent, const ReferenceForces& reference, std::vector<int> support,
                           const IterationObserver& observer)
    : mesh_(mesh),
      dofs_(dofs),
      assembler_(assembler),
      elimination_(elimination),
      options_(options),
      counters_(counters),
      tangent_(tangent),
      support_(std::move(support)),
      observer_(observer),
      criterion_(options),
      reference_(reference),
      held_(elimination, tangent),
      prediction_(options.tangent.prediction),
      policy_(options.tangent),
      most_iterations_(options.max_iterations) {}

void NewtonSolver::start_step(double duration) {
  policy_ = options_.tangent;
  most_iterations_ = options_.max_iterations;
  duration_ = duration;
  is_moved_ = false;
  is_short_ = duration < policy_.elastic_below;
  if (is_short_) {
    policy_.correction = TangentKind::elastic;
    policy_.iterations = policy_.elastic_iterations;
    most_iterations_ = options_.max_elastic_iterations;
  }
  if (!contact_stiffens_) return;
  policy_.steps = policy_.iterations = 1;
  if (policy_.correction == TangentKind::elastic) policy_.correction = TangentKind::unloading;
}

int NewtonSolver::solve(double time, const Eigen::VectorXd& external, Eigen::VectorXd offset,
                        const ConditionSet& conditions, int earlier, int active_set_limit, NewtonState& state) {
  active_set_limit_ = active_set_limit;
  take_conditions(time, conditions, offset, state);
  start(external, offset, earlier + 1, state);
  std::vector<IterationReport> history;
  int most = std::max(1, most_iterations_ - earlier);
  for (int iteration = 1; iteration <= most; ++iteration) {
    if (iteration > 1 && is_tangent_due(policy_, tangent_, earlier + iteration, steps_) &&
        tangent_.refresh(state.u, kind_of(earlier + iteration)))
      forget_stiffness();
    ++counters_.newton_iterations;
    const Eigen::VectorXd before = state.reduced, where = state.u, balance = balance_;
    if (passes_over() && row_multipliers_.size() > 0) beginning_ = violations_at(state.u);
    Correction correction = correct(state, offset);
    const Eigen::VectorXd change = state.u - where;
    if (relations_.update) offset = relations_.update(time, state);
    const bool is_linear = mixed_ && mixed_->is_linear();
    if (is_linear) correction.changes = mixed_->linearise(state.u, time);
    const double taken = searches(earlier + iteration) ? search(before, external, offset, state) : 1.0;
    const bool is_whole = taken == 1.0 || !has_conditions();
    if (knows_reactions()) held_.take(held_.of(balance, change), taken);
    evaluate(state, external);
    const auto measure = distance(state);
    history.push_back(report(time, earlier + iteration, measure, correction.changes, state));
    if (observer_) observer_(history.back());
    if (mixed_) mixed_->note_residual(measure.relative);
    if (measure.converged && is_whole && (!mixed_ || mixed_->may_end(correction.changes)) && is_satisfied(state.u)) {
      if (!is_linear && !relations_.update) polish(state, external, offset);
      require_at_hand(time, state.u);
      criterion_.take_up(load_);
      course_.note(time, state.multipliers);
      return iteration;
    }
    if (!std::isfinite(measure.absolute)) break;
    look_at_residuals(watch_, history);
    if (iteration == most && earlier + most >= most_iterations_)
      most += further_iterations(time, history, measure.excess);
  }
  if (stands_unconverged(options_, history)) return history.back().iteration;
  fail(time, history);
}

/// So far away whatever is left of the loads passes for rounding.
void NewtonSolver::require_at_hand(double time, const Eigen::VectorXd& u) const {
  if (!mixed_ || tangent_.springs().empty()) return;
  double farthest = 0.0;
  for (int dof = 0; dof < dofs_.size(); ++dof)
    if (dofs_.component_of(dof) <= Component::dz) farthest = std::max(farthest, std::abs(u[dof]));
  const double size = extent(mesh_);
  if (farthest > farthest_motion * size) throw_lost_body(time, farthest / size, tangent_.unheld());
}

/// Beyond the most, where the residuals promise to get there: up to all that are allowed, and as many again where the
/// promise is not kept. Of two criteria that of the loads counts while it is not met.
int NewtonSolver::further_iterations(double time, const std::vector<IterationReport>& history, double excess) const {
  const int further = static_cast<int>(std::lround(watch_.further * most_iterations_));
  if (further <= 0) return 0;
  const IterationReport& last = history.back();
  const bool to_loads = options_.relative_residual && last.relative_residual > *options_.relative_residual;
  if (!to_loads && !(excess > 1.0)) return 0;
  std::vector<double> residuals;
  for (const IterationReport& each : history)
    residuals.push_back(to_loads ? each.relative_residual : each.absolute_residual);
  const double limit = to_loads ? *options_.relative_residual : last.absolute_residual / excess;
  const std::optional<int> needed = expected_iterations(residuals, limit);
  if (!needed || *needed > most_iterations_ + further) return 0;
  if (observer_)
    observer_(
        event_of_step(time, fmt::format("{} more iterations are allowed: the residual shrinks as if it took {} in all",
                                        further, *needed + 1)));
  return further;
}

/// The tangent and the residual of the first iteration, which is not the step's first where a new geometry of contact
/// goes on from the one before (Code_Aster 17.3). A nonlinear body is left where it is in balance, and what the
/// conditions on displacements move goes through the tangent: moved alone, the nodes under conditions would tear at the
/// elements beside them.
void NewtonSolver::start(const Eigen::VectorXd& external, const Eigen::VectorXd& offset, int iteration,
                         NewtonState& state) {
  const Eigen::VectorXd moved = elimination_.transformation() * state.reduced + offset;
  const Eigen::VectorXd imposed = moved - state.u;
  const bool is_linear = tangent_.is_constant();
  const Eigen::VectorXd before = state.u;
  if (is_linear) state.u = moved;
  variable_forces_ = assembler_.variable_forces();
  weights_.take(assembler_, elimination_);
  const bool is_other =
      is_short_ && tangent_.kind() != policy_.correction;  // one that is not due goes on from a step of normal length
  if ((is_other || is_tangent_due(policy_, tangent_, iteration, steps_)) &&
      tangent_.refresh(state.u, kind_of(iteration)))
    forget_stiffness();
  const auto forces_at = [&](const Eigen::VectorXd& u) {
    return iteration == 1 && !is_moved_ ? assembler_.starting_forces(u) : assembler_.internal_forces(u);
  };
  const bool may_be_known = is_linear && variable_forces_.size() == 0;
  measure(loads_at(state.u, external),
          may_be_known ? known_forces_.after_move(before, moved, forces_at) : forces_at(state.u));
  if (!is_linear && !imposed.isZero(0.0)) residual_ -= tangent_.reduced_forces(state.u, imposed, kind_of(iteration));
}

void NewtonSolver::forget_stiffness() {
  known_forces_ = {};
  if (schur_) schur_->forget();
  if (mixed_) mixed_->forget();
}

TangentKind NewtonSolver::kind_of(int iteration) const {
  if (iteration > 1 || is_short_ || is_moved_) return policy_.correction;
  return at_start(prediction_);
}

NewtonSolver::Correction NewtonSolver::correct(NewtonState& state, const Eigen::VectorXd& offset) {
  const Eigen::VectorXd before = state.reduced;
  Eigen::MatrixXd step = residual_;
  if (mixed_) step -= mixed_->forces_left_out();
  if (step.size()) tangent_.solve_correction(step, state.u);
  Correction correction;
  if (mixed_) {
    state.reduced = before + step;
    correction.changes = mixed_->correct(before, offset, state.reduced);
  } else {
    state.reduced = before + step;
    if (row_multipliers_.size()) correction = correct_with_conditions(state);
  }
  double size = 0.0, change = 0.0;
  for (Eigen::Index k = 0; k < state.reduced.size(); ++k) {
    if (!is_motion(dofs_.component_of(elimination_.kept()[static_cast<std::size_t>(k)])))
      continue;  // a pressure has another unit
    size = std::max(size, std::abs(state.reduced[k]));
    change = std::max(change, std::abs(state.reduced[k] - before[k]));
  }
  correction.step = size > 0.0 ? change / size : 0.0;
  state.u = elimination_.transformation() * state.reduced + offset;
  return correction;
}

/// Whether relations that are taken anew in each iteration hold.
bool NewtonSolver::is_satisfied(const Eigen::VectorXd& u) const {
  return !relations_.violation || relations_.violation(u) <= largest_violation;
}

bool NewtonSolver::searches(int iteration) const {
  return options_.line_search && !relations_.update && iteration > 1 && !tangent_.is_constant() &&
         !(mixed_ && mixed_->is_linear());
}

/// Takes the unknowns from `before` along the correction that has brought them where they are. While the line is
/// searched, loads that follow stay as they were (R5.03.01; ssnv122b tells), and contact forces as the correction has
/// found them. Returns the share of the correction that was taken: where it is 1, conditions hold as it left them.
double NewtonSolver::search(const Eigen::VectorXd& before, const Eigen::VectorXd& external,
                            const Eigen::VectorXd& offset, NewtonState& state) {
  const Eigen::VectorXd step = state.reduced - before;
  const auto go = [&](double rho) {
    state.reduced = before + rho * step;
    state.u = elimination_.transformation() * state.reduced + offset;
  };
  if (has_conditions()) {
    evaluate(state, external);
    if (distance(state).converged) return 1.0;
  }
  go(0.0);
  const Eigen::VectorXd held = loads_at(state.u, external);
  const auto work = [&](double rho) {
    go(rho);
    measure(held, assembler_.internal_forces(state.u));
    return step.dot(residual_);
  };
  // The residual at hand is that before the correction, unless contact forces have changed with it.
  const double start = has_conditions() ? work(0.0) : step.dot(residual_);
  const double reached = search_line(*options_.line_search, start, work);
  go(reached);
  return reached;
}

/// With a constant tangent a correction costs one solve, and the criterion alone would leave a soft body where rounding
/// put it: residuals of 1e-6 of the largest force move a body on weak springs by metres. A residual that is rounding,
/// of a stiffness that loses few digits, says that there is nothing to gain.
void NewtonSolver::polish(NewtonState& state, const Eigen::VectorXd& external, const Eigen::VectorXd& offset) {
  if (!tangent_.is_constant()) return;
  double last = std::numeric_limits<double>::infinity();
  if (tangent_.loses_few_digits() && is_rounding(state)) return;
  const int rounds = tangent_.loses_few_digits() ? 1 : max_polishing;
  for (int k = 0; k < rounds; ++k) {
    const double step = correct(state, offset).step;
    evaluate(state, external);
    if (step <= negligible_step || step > 0.5 * last) return;
    last = step;
  }
}

std::optional<double> NewtonSolver::penetration(const NewtonState& state) const {
  if (mixed_) return mixed_->penetration(state.u);
  if (!row_multipliers_.size()) return std::nullopt;
  return std::max(0.0, (reduced_.inequalities.rows * state.reduced - reduced_.inequalities.bounds).maxCoeff());
}

IterationReport NewtonSolver::report(double time, int iteration, const ConvergenceCriterion::Measure& measure,
                                     int changes, const NewtonState& state) const {
  IterationReport line;
  line.instant = time;
  line.iteration = iteration;
  line.relative_residual = measure.relative;
  line.absolute_residual = measure.absolute;
  line.worst = worst_place(weights_.weighed(residual_), elimination_, dofs_, mesh_);
  line.active_conditions = mixed_ ? mixed_->closed_count() : static_cast<int>(active_.size());
  line.contact_changes = changes;
  line.penetration = penetration(state);
  return line;
}

void NewtonSolver::fail(double time, const std::vector<IterationReport>& history) const {
  throw_no_convergence(time, history, options_,
                       {.is_linear = tangent_.is_constant(),
                        .is_elastic = policy_.correction == TangentKind::elastic,
                        .has_contact = has_conditions(),
                        .unheld = tangent_.unheld()});
}

}  // namespace comma::solver
