#include "solver/contact/frictionless.hpp"

#include <limits>

#include "solver/unilateral/active_set.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;

/// Changes of the active set, one row at a time, a row.
constexpr int changes_a_row = 30;

bool is_one_of_a_kind(const CondensedPoint& point) {
  return point.node_count == 1 && point.shape[0] == 1.0 && point.components == 1 && !point.bilateral && !point.law.penalised &&
         !(point.law.friction > 0.0);
}

bool is_frictionless(const CondensedProblem& problem) {
  if (!problem.springs.empty() || problem.indefinite || problem.components != 1) return false;
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
    if (problem.points[p].rows > 0 && state.statuses[p] != ContactStatus::open) result.guess.push_back(problem.points[p].first_row);
  return result;
}

}  // namespace

std::optional<CondensedSolution> solve_frictionless(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state) {
  if (!is_frictionless(problem)) return std::nullopt;
  ActiveSetMemory own;
  const ActiveSetSolution solution = solve_active_set(schur, inequalities(schur, problem, state), problem.memory ? *problem.memory : own);
  if (solution.verdict != ActiveSetVerdict::solved) return std::nullopt;
  std::vector<char> closed(static_cast<std::size_t>(schur.size()), 0);
  for (const int row : solution.active) closed[static_cast<std::size_t>(row)] = 1;
  CondensedSolution result;
  result.iterations = solution.iterations + 1;
  result.forces = solution.multipliers;
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

}  // namespace comma::solver
