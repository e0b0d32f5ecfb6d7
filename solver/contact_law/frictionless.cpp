#include "solver/contact_law/frictionless.hpp"

#include <limits>

#include "solver/unilateral/active_set.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;

/// Changes of the active set, one row at a time, a row.
constexpr int changes_a_row = 30;
/// Rounds with springs that follow the body, and the change of their forces, as a share of the largest of contact, at
/// which they are at rest.
constexpr int most_rounds = 200;
constexpr double at_rest = 1e-13;
/// Below this share they are at rest where they shrink no more: products of many rows round them.
constexpr double nearly_at_rest = 1e-9;
/// The excess of a row that is never active.
constexpr double never = -std::numeric_limits<double>::max() / 4.0;

bool is_one_of_a_kind(const CondensedPoint& point) {
  return point.node_count == 1 && point.shape[0] == 1.0 && point.components == 1 && !point.bilateral &&
         !point.law.penalised && !(point.law.friction > 0.0);
}

bool is_frictionless(const CondensedProblem& problem) {
  if (problem.indefinite || problem.components != 1) return false;
  std::vector<char> taken(static_cast<std::size_t>(problem.node_count), 0);
  for (const CondensedPoint& point : problem.points) {
    if (point.rows == 0) continue;
    if (!is_one_of_a_kind(point) || taken[static_cast<std::size_t>(point.nodes[0])]++) return false;
  }
  return true;
}

ActiveSetProblem inequalities(SchurComplement& schur, const CondensedProblem& problem, const CondensedState& state) {
  const Eigen::VectorXd held = schur.times(problem.held);
  ActiveSetProblem result;
  result.excess = held - problem.free;
  result.scale = problem.free.cwiseAbs() + held.cwiseAbs();
  result.scale.array() += std::max(problem.displacement, std::numeric_limits<double>::min());
  result.max_iterations = changes_a_row * static_cast<int>(problem.free.size());
  for (std::size_t p = 0; p < problem.points.size(); ++p)
    if (problem.points[p].rows > 0 && state.statuses[p] != ContactStatus::open)
      result.guess.push_back(problem.points[p].first_row);
  return result;
}

/// `forces`: on all rows.
CondensedSolution conclude(const ActiveSetSolution& solution, Eigen::VectorXd forces, int iterations,
                           const CondensedProblem& problem, CondensedState& state) {
  std::vector<char> closed(static_cast<std::size_t>(forces.size()), 0);
  for (const int row : solution.active) closed[static_cast<std::size_t>(row)] = 1;
  CondensedSolution result;
  result.iterations = iterations;
  result.forces = std::move(forces);
  state.multipliers.setZero();
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const CondensedPoint& point = problem.points[p];
    const bool touches = point.rows > 0 && closed[static_cast<std::size_t>(point.first_row)];
    const ContactStatus status = touches ? ContactStatus::sliding : ContactStatus::open;
    result.changes += status != state.statuses[p];
    state.statuses[p] = status;
    if (touches) state.multipliers[point.nodes[0]] = solution.multipliers[point.first_row] / point.weight;
  }
  return result;
}

/// On all rows, those of springs alone being other than zero.
Eigen::VectorXd spring_forces(const CondensedProblem& problem, const Eigen::VectorXd& jumps) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(jumps.size());
  for (const CondensedSpring& spring : problem.springs) forces[spring.row] = spring.stiffness * jumps[spring.row];
  return forces;
}

/// While the same rows are active a round takes the forces of the springs F to G F + c: what they change by until they
/// are at rest, (1 - G)^-1 times what they change by in one round; that change itself where there is no such place.
Eigen::VectorXd change_to_rest(SchurComplement& schur, const CondensedProblem& problem, const std::vector<int>& active,
                               const Eigen::VectorXd& change) {
  std::vector<int> rows = active;
  for (const CondensedSpring& spring : problem.springs) rows.push_back(spring.row);
  const auto count = static_cast<Index>(rows.size()), touching = static_cast<Index>(active.size()),
             springs = count - touching;
  Eigen::SparseMatrix<double> one_each(count, count);
  one_each.setIdentity();
  schur.require(rows);
  const Eigen::MatrixXd compliance = schur.responses(rows, one_each).whole();
  const Eigen::MatrixXd between = compliance.topRightCorner(touching, springs);
  Eigen::MatrixXd held = compliance.bottomRightCorner(springs, springs);
  held -= between.transpose() * compliance.topLeftCorner(touching, touching).ldlt().solve(between);
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(springs, springs);
  Eigen::VectorXd own(springs);
  for (Index s = 0; s < springs; ++s) {
    const CondensedSpring& spring = problem.springs[static_cast<std::size_t>(s)];
    system.row(s) -= spring.stiffness * held.row(s);
    own[s] = change[spring.row];
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(system);
  if (!factor.isInvertible()) return change;
  const Eigen::VectorXd whole = factor.solve(own);
  Eigen::VectorXd result = change;
  for (Index s = 0; s < springs; ++s) result[problem.springs[static_cast<std::size_t>(s)].row] = whole[s];
  return result;
}

}  // namespace

std::optional<CondensedSolution> solve_frictionless(SchurComplement& schur, const CondensedProblem& problem,
                                                    CondensedState& state) {
  if (!problem.springs.empty() || !is_frictionless(problem)) return std::nullopt;
  ActiveSetMemory own;
  const ActiveSetSolution solution =
      solve_active_set(schur, inequalities(schur, problem, state), problem.memory ? *problem.memory : own);
  if (solution.verdict != ActiveSetVerdict::solved) return std::nullopt;
  return conclude(solution, solution.multipliers, solution.iterations + 1, problem, state);
}

std::optional<CondensedSolution> solve_afloat(SchurComplement& schur, const CondensedProblem& problem,
                                              CondensedState& state) {
  if (problem.springs.empty() || !is_frictionless(problem)) return std::nullopt;
  ActiveSetProblem asked = inequalities(schur, problem, state);
  const Eigen::VectorXd without = asked.excess;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(without.size());
  ActiveSetMemory memory;
  int iterations = 0;
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_rounds; ++round) {
    asked.excess = without - schur.times(forces);
    for (const CondensedSpring& spring : problem.springs) asked.excess[spring.row] = never;
    const ActiveSetSolution solution = solve_active_set(schur, asked, memory);
    if (solution.verdict != ActiveSetVerdict::solved) return std::nullopt;
    iterations += solution.iterations + 1;
    const Eigen::VectorXd change =
        spring_forces(problem, schur.times(forces + solution.multipliers) - without) - forces;
    const double left = change.lpNorm<Eigen::Infinity>(), size = solution.multipliers.lpNorm<Eigen::Infinity>();
    if (left <= at_rest * size || (left <= nearly_at_rest * size && left >= 0.5 * last))
      return conclude(solution, solution.multipliers + forces, iterations, problem, state);
    last = left;
    forces += solution.active == asked.guess ? change_to_rest(schur, problem, solution.active, change) : change;
    asked.guess = solution.active;
  }
  return std::nullopt;
}

}  // namespace comma::solver
