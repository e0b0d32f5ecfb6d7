// The part of NewtonSolver that brings a correction to where unilateral conditions on displacements hold.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "solver/contact/extent.hpp"
#include "solver/error.hpp"
#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/iterations/newton.hpp"
#include "solver/unilateral/admissible_gradient.hpp"
#include "solver/unilateral/projected_gradient.hpp"
#include "solver/unilateral/rounds.hpp"
#include "solver/unilateral/status_iteration.hpp"

namespace comma::solver {
namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Conditions of which gradients take the compliance as a matrix: beyond (288 MB), they solve for each product instead.
constexpr int most_dense_rows = 6000;

int count_changes(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> changed;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(changed));
  return static_cast<int>(changed.size());
}

}  // namespace

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
  if (passes_over()) problem.beginning = beginning_;

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

/// Of the reduced rows, at displacements that need not be those of the step's end.
Eigen::VectorXd NewtonSolver::violations_at(const Eigen::VectorXd& u) const {
  const Eigen::VectorXd all = conditions_->full.rows * u - conditions_->full.bounds;
  return all(reduced_.origin);
}

void NewtonSolver::note_doubts(const NewtonState& state, ContactDoubts& doubts) {
  note_passed_bounds(state, doubts);
  if (passes_over() && row_multipliers_.size() > 0) note_passed_over(state, doubts);
}

/// Open nodes that lie inside the master.
void NewtonSolver::note_passed_over(const NewtonState& state, ContactDoubts& doubts) {
  Eigen::VectorXd depth = reduced_.inequalities.rows * state.reduced - reduced_.inequalities.bounds;
  for (const int row : active_) depth[row] = 0.0;
  for (Eigen::Index row = 0; row < depth.size(); ++row) {
    if (!(depth[row] > rounding_of_length * extent(mesh_))) continue;
    const int slot = conditions_->row_slots[static_cast<std::size_t>(reduced_.origin[static_cast<std::size_t>(row)])];
    doubts.note({.kind = DoubtKind::passed_over,
                 .zone = zone_of(static_cast<int>(row)),
                 .share = depth[row],
                 .length = depth[row],
                 .node = conditions_->pairs[static_cast<std::size_t>(slot)].slave});
  }
}

void NewtonSolver::note_passed_bounds(const NewtonState& state, ContactDoubts& doubts) {
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

}  // namespace comma::solver
