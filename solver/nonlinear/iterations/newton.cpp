#include "solver/nonlinear/iterations/newton.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "solver/contact/extent.hpp"
#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/iterations/line_search.hpp"
#include "solver/unilateral/admissible_gradient.hpp"
#include "solver/unilateral/projected_gradient.hpp"
#include "solver/unilateral/rounds.hpp"
#include "solver/unilateral/status_iteration.hpp"

namespace comma::solver {
namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A correction below this share of the solution is rounding.
constexpr double negligible_step = 4e-16;
/// A rigid body is one up to this share of its size.
constexpr double largest_violation = 1e-9;
/// Corrections after convergence, at most. Each gains the digits that the factorisation has to give: one is enough
/// where it has nearly all of them, two unless it has less than a third.
constexpr int max_polishing = 3;
/// Conditions of which gradients take the compliance as a matrix: beyond (288 MB), they solve for each product instead.
constexpr int most_dense_rows = 6000;

int count_changes(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> changed;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(changed));
  return static_cast<int>(changed.size());
}

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

void NewtonSolver::take_conditions(double time, const ConditionSet& conditions, const Eigen::VectorXd& offset,
                                   const NewtonState& state) {
  conditions_ = &conditions;
  reduced_ =
      reduce(conditions.full, elimination_, offset, [&](int row) { return describe(conditions, row, mesh_, dofs_); });
  std::vector<int> slots;
  for (const int row : reduced_.origin) slots.push_back(conditions.row_slots[row]);
  if (!schur_) {
    schur_ = std::make_unique<SchurComplement>(
        reduced_.inequalities.rows, [this](Eigen::Ref<Eigen::MatrixXd> columns) { tangent_.solve_once(columns); },
        support_, slots);
    schur_->soften(reduced_.inequalities.softness);
    schur_->use_whole([this](const RowMatrix& rows) { return tangent_.compliance(rows); });
  } else {
    schur_->replace_rows(reduced_.inequalities.rows, slots, reduced_.inequalities.softness);
  }
  // Of linear bodies the solution does not depend on where it is sought from, and with an exact compliance nor does the
  // work.
  const bool expects = tangent_.is_constant() && !schur_->is_exact();
  course_.begin(time - duration_, state.multipliers);
  const Eigen::VectorXd multipliers = expects ? course_.expected(time, state.multipliers) : state.multipliers;
  row_multipliers_.resize(static_cast<Eigen::Index>(reduced_.origin.size()));
  active_.clear();
  for (std::size_t row = 0; row < reduced_.origin.size(); ++row) {
    const double multiplier = multipliers[conditions.row_slots[reduced_.origin[row]]];
    row_multipliers_[static_cast<Eigen::Index>(row)] = multiplier;
    if (multiplier > 0.0) active_.push_back(static_cast<int>(row));
  }
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

/// `state.reduced` is balanced by the present multipliers, and is brought to where the conditions hold. A compliance of
/// earlier rows or of an earlier stiffness leaves something to the next round; where that does not shrink, the
/// compliance is made anew.
NewtonSolver::Correction NewtonSolver::correct_with_conditions(NewtonState& state) {
  const std::vector<int> before = active_;
  if (!by_compliance())
    settle_conditions(state);
  else
    settle_in_rounds(*schur_, tangent_.negligible_rest(), [&] { return settle_conditions(state); });
  Correction correction;
  correction.changes = count_changes(before, active_);
  state.multipliers.setZero();
  for (const int row : active_) state.multipliers[conditions_->row_slots[reduced_.origin[row]]] = row_multipliers_[row];
  return correction;
}

/// By how much multipliers change, as a share of the largest; nothing where a compliance that is not exact finds no
/// solution.
std::optional<double> NewtonSolver::settle_conditions(NewtonState& state) {
  const Inequalities& rows = reduced_.inequalities;
  ActiveSetProblem problem;
  problem.guess = active_;
  problem.max_iterations = active_set_limit_;
  // The present multipliers balance the displacements: taking them back gives what those would be without any.
  const Eigen::VectorXd held = push_of_active();
  problem.excess = rows.rows * state.reduced - rows.bounds + held;
  const Eigen::VectorXd u = elimination_.transformation() * state.reduced;
  const Eigen::VectorXd magnitudes = tangent_.magnitudes(u);
  problem.scale = rows.bounds.cwiseAbs() + held.cwiseAbs();
  for (int row = 0; row < rows.rows.outerSize(); ++row)
    for (SparseRows::InnerIterator it(rows.rows, row); it; ++it)
      problem.scale[row] += magnitudes[elimination_.kept()[static_cast<std::size_t>(it.col())]] * std::abs(it.value());
  problem.scale = problem.scale.cwiseMax(std::numeric_limits<double>::min());

  const bool is_exact = !by_compliance() || schur_->is_exact();
  ActiveSetSolution solution = solve_conditions(problem);
  counters_.contact_iterations += solution.iterations;
  if (solution.verdict != ActiveSetVerdict::solved && !is_exact) return std::nullopt;
  throw_unless_solved(solution);
  const Eigen::VectorXd change = solution.multipliers - row_multipliers_;
  if (change.cwiseAbs().maxCoeff() > 0.0) {
    Eigen::MatrixXd push = rows.rows.transpose() * change;
    tangent_.solve_correction(push, u);
    state.reduced -= push;
  }
  row_multipliers_ = std::move(solution.multipliers);
  active_ = std::move(solution.active);
  const double size = largest_component(row_multipliers_);
  return size > 0.0 ? largest_component(change) / size : largest_component(change);
}

void NewtonSolver::throw_unless_solved(const ActiveSetSolution& solution) const {
  if (solution.verdict == ActiveSetVerdict::contradictory) {
    std::vector<int> full;
    for (const int row : solution.contradiction) full.push_back(reduced_.origin[row]);
    throw_contradiction(*conditions_, full, mesh_, dofs_);
  }
  if (solution.verdict == ActiveSetVerdict::too_many_iterations)
    throw_active_set_limit(by_gradients() ? solution.iterations : active_set_limit_, by_gradients());
}

/// Whether the compliance of all rows is worth its memory: the active set needs it, for gradients it saves two solves
/// an iteration.
bool NewtonSolver::by_compliance() const {
  return !by_gradients() ||
         (tangent_.gives_compliance() && schur_->size() >= static_cast<int>(SchurComplement::many_columns) &&
          schur_->size() <= most_dense_rows);
}

/// By how much the present multipliers push the rows back: S times them, less what soft rows give way.
Eigen::VectorXd NewtonSolver::push_of_active() {
  if (active_.empty()) return Eigen::VectorXd::Zero(row_multipliers_.size());
  return compliance_times(row_multipliers_) - reduced_.inequalities.softness.cwiseProduct(row_multipliers_);
}

int NewtonSolver::zone_of(int row) const {
  return conditions_->row_zones[static_cast<std::size_t>(reduced_.origin[static_cast<std::size_t>(row)])];
}

std::vector<double> NewtonSolver::pushed_back(std::size_t zones) {
  std::vector<double> result(zones, 0.0);
  std::map<int, std::vector<int>> closed;
  for (const int row : active_) closed[zone_of(row)].push_back(row);
  const auto take = [&](const Eigen::VectorXd& pushed, auto&& is_meant) {
    for (int row = 0; row < static_cast<int>(pushed.size()); ++row) {
      double& most = result[static_cast<std::size_t>(zone_of(row))];
      if (is_meant(zone_of(row))) most = std::max(most, std::abs(pushed[row]));
    }
  };
  take(push_of_active(), [&](int zone) { return closed.contains(zone); });
  if (closed.size() < 2) return result;
  for (const auto& [zone, rows] : closed) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(row_multipliers_.size());
    own(rows) = row_multipliers_(rows);
    take(compliance_times(own) - reduced_.inequalities.softness.cwiseProduct(own),
         [&, zone = zone](int each) { return each == zone; });
  }
  return result;
}

void NewtonSolver::note_doubts(const NewtonState& state, ContactDoubts& doubts) {
  const Eigen::VectorXd& softness = reduced_.inequalities.softness;
  if (active_.empty() || (softness.isZero(0.0) && !by_gradients())) return;
  const Eigen::VectorXd past =
      by_gradients() ? Eigen::VectorXd(reduced_.inequalities.rows * state.reduced - reduced_.inequalities.bounds)
                     : Eigen::VectorXd(softness.cwiseProduct(row_multipliers_));
  const double size = extent(mesh_);
  if (!(past(active_).maxCoeff() > rounding_of_length * size)) return;
  const Eigen::VectorXd pushed = push_of_active();
  struct Passed {
    double most = 0.0, reach = 0.0, softest = 0.0;
  };
  std::map<int, Passed> conditions;
  for (const int row : active_) {
    if (!(softness[row] > 0.0) && !by_gradients()) continue;
    Passed& passed = conditions[zone_of(row)];
    passed.reach = std::max(passed.reach, past[row] + pushed[row]);
    if (past[row] <= passed.most) continue;
    passed.most = past[row];
    passed.softest = softness[row];
  }
  for (const auto& [condition, passed] : conditions) {
    if (!(passed.most > 0.0)) continue;
    ContactDoubt doubt{.zone = condition, .length = passed.most};
    doubt.kind = by_gradients() ? DoubtKind::coarse_gradients : DoubtKind::soft_bound;
    doubt.penalty = by_gradients() ? definition_->gradient_tolerance : 1.0 / passed.softest;
    note_soft_penalty(doubt, passed.reach, size, doubts);
  }
}

ActiveSetSolution NewtonSolver::solve_conditions(const ActiveSetProblem& problem) {
  if (tangent_.is_indefinite()) return solve_by_statuses(*schur_, problem);
  return by_gradients() ? solve_by_gradients(problem) : solve_active_set(*schur_, problem, memory_);
}

Eigen::VectorXd NewtonSolver::compliance_times(const Eigen::VectorXd& multipliers) {
  if (by_compliance()) return schur_->times(multipliers);
  Eigen::MatrixXd push = reduced_.inequalities.rows.transpose() * multipliers;
  tangent_.solve_once(push);
  return reduced_.inequalities.rows * push;
}

ActiveSetSolution NewtonSolver::solve_by_gradients(const ActiveSetProblem& problem) {
  const auto& rows = reduced_.inequalities.rows;
  const auto apply = [this](const Eigen::VectorXd& x) { return compliance_times(x); };
  if (!definition_->gradient_scaled) {
    auto solution = solve_admissible_gradient(apply, problem,
                                              {.tolerance = definition_->gradient_tolerance,
                                               .max_iterations = definition_->gradient_iterations,
                                               .start = row_multipliers_,
                                               .stays_admissible = definition_->gradient_stays_admissible});
    if (solution) return *std::move(solution);
  }
  ProjectedGradientOptions options;
  options.tolerance = definition_->gradient_tolerance;
  options.max_iterations = definition_->gradient_iterations;
  options.start = row_multipliers_;
  if (definition_->gradient_scaled) {
    options.scaling = Eigen::VectorXd::Zero(rows.rows());
    for (int row = 0; row < rows.outerSize(); ++row)
      for (SparseRows::InnerIterator it(rows, row); it; ++it)
        options.scaling[row] += it.value() * it.value() * tangent_.row_sizes()[it.col()];
    options.scaling = options.scaling.cwiseSqrt();
  }
  ActiveSetSolution solution = solve_projected_gradient(apply, problem, options);
  if (solution.verdict == ActiveSetVerdict::contradictory)
    throw Error("contradictory-conditions",
                "projected conjugate gradients find contact forces without bound: some conditions cannot hold together",
                "solve with ALGO_CONT='CONTRAINTE', which names them");
  return solution;
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
