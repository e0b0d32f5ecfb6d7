// Active-set solution of A u <= b on the Schur complement.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/unilateral/active_cholesky.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// What is asked of the multipliers: find lambda >= 0 with w = excess - S lambda <= 0 and lambda^T w = 0, that is the
/// dual of  min 1/2 u^T K u - f^T u  subject to  A u <= b.
struct ActiveSetProblem {
  Eigen::VectorXd excess;  ///< A u0 - b for the solution u0 without conditions (m)
  /// Size of the terms that make up A u - b, row by row (m, > 0): tolerances are relative to it.
  Eigen::VectorXd scale;
  std::vector<int> guess;     ///< rows that were active before
  int max_iterations = 1000;  ///< changes of the active set, at most
  /// A u - b (m) where the iteration begins that leads to u0. Not empty: the solution is that of a walk from there,
  /// which the active set of Code_Aster is (R5.03.50; found from the lists that 17.3 prints). It may leave rows
  /// violated: those that u0 holds and that end less violated than here.
  Eigen::VectorXd beginning;
};

/// What the method keeps from one solution to the next: the factor of the rows that were active, good as long as S is
/// the same.
struct ActiveSetMemory {
  std::vector<int> active;  ///< in the order of the factor
  ActiveCholesky factor;
  long version = -1;  ///< of S
};

enum class ActiveSetVerdict : std::uint8_t { solved, contradictory, too_many_iterations };

struct ActiveSetSolution {
  ActiveSetVerdict verdict = ActiveSetVerdict::solved;
  Eigen::VectorXd multipliers;  ///< m, >= 0
  std::vector<int> active;      ///< rows with equality, rising
  int iterations = 0;
  /// Rows that cannot hold together (verdict contradictory); the first is the violated one.
  std::vector<int> contradiction;
};

/// Rows whose multiplier is positive, rising.
std::vector<int> positive_rows(const Eigen::VectorXd& multipliers);

/// First in packets: all violated rows enter and all pulling ones leave at once, which finds most contact states in two
/// or three rounds; then, if that does not settle, the dual method of Goldfarb and Idnani (Mathematical Programming 27,
/// 1983) one row at a time, which is finite because the dual function rises at each full step. Rows that depend on
/// active ones never enter together with them; a violated one that nothing active can make room for is a contradiction.
ActiveSetSolution solve_active_set(SchurComplement& schur, const ActiveSetProblem& problem);
ActiveSetSolution solve_active_set(SchurComplement& schur, const ActiveSetProblem& problem, ActiveSetMemory& memory);

/// A row is violated when it exceeds its bound by more than this share of its scale: above the rounding of K^-1, below
/// any gap that matters.
inline constexpr double violation_tolerance = 1e-12;
/// A violated row that depends on active ones is a contradiction beyond this share of its scale, and the same condition
/// written twice below it.
inline constexpr double contradiction_tolerance = 1e-8;

}  // namespace comma::solver
