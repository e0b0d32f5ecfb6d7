// One interface for all solvers of symmetric systems (design: analyse once a pattern, factorise once a
// stiffness).
//
// Every direct solver works on the equilibrated matrix S A S and refines its solutions against the matrix as given, see
// refined_solver.hpp; docs/linear_solvers.md shows what that buys on nearly singular matrices.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace comma::solver {

/// Symmetric; only the lower triangle is stored, diagonal included (an explicit entry on every row).
using SymmetricMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

enum class LinearMethod : std::uint8_t { mumps, cholmod, eigen_ldlt, conjugate_gradient, multigrid };
std::string_view name_of(LinearMethod method);

/// Where the unknowns of a solid lie, for the method that asks: three translations a node at most.
struct SolidUnknowns {
  std::vector<int> nodes;               ///< of each row: 0, 1, ...
  std::vector<int> axes;                ///< of each row: 0, 1, 2
  std::vector<Eigen::Vector3d> places;  ///< of each node, m
};

enum class FactorVerdict : std::uint8_t { ok, indefinite, singular };

/// What a factorisation found. `ok`: positive definite.
struct FactorReport {
  FactorVerdict verdict = FactorVerdict::ok;
  std::vector<int> null_rows;  ///< rows without a usable pivot (verdict singular), rising
  int lost_digits = 0;         ///< whole decimal digits lost on the worst pivot, relative to its initial diagonal (at
                        ///< most 17). MUMPS keeps its pivots to itself: there it is an estimate by inverse iteration
};

struct LinearOptions {
  /// A pivot that loses more whole decimal digits than this is null (Code_Aster's NPREC, U4.50.01); negative: never
  /// tested, only a pivot of exactly zero is null then.
  int singular_digits = 8;
  /// Steps of iterative refinement at most, the residual in doubled precision. They end as soon as a correction no
  /// longer changes the solution: one step is usual, a matrix of condition 1e15 needs a dozen. 0: none.
  int refinement_steps = 20;
  /// Power-of-two scaling of rows and columns; only a study of its effect turns it off.
  bool equilibrate = true;
  /// Conjugate gradients alone: residual relative to the right-hand side at which they stop (RESI_RELA), and how many
  /// iterations they may take (NMAX_ITER; 0: half the unknowns).
  double iteration_tolerance = 1e-6;
  int most_iterations = 0;
  /// Multigrid alone, which needs it.
  std::shared_ptr<const SolidUnknowns> solid;
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual LinearMethod method() const = 0;
  /// Symbolic analysis of a pattern.
  virtual void analyse(const SymmetricMatrix& matrix) = 0;
  /// Numeric factorisation; keeps a copy for refinement. A matrix of another pattern than the analysed one is analysed
  /// again. Throws Error `not-finite` naming the row of an entry that is infinite or not a number; `out-of-memory`.
  virtual FactorReport factorise(const SymmetricMatrix& matrix) = 0;
  /// rhs: size n x k, overwritten by the solution. Returns the largest relative residual
  /// |b - A x|_inf / (|A|_inf |x|_inf + |b|_inf) of the columns. Throws Error `singular-matrix` if the last
  /// factorisation was singular, `inaccurate-solution` if the residual stays above `worst_residual` (an indefinite
  /// matrix met by a solver that does not pivot; MUMPS does).
  virtual double solve(Eigen::Ref<Eigen::MatrixXd> rhs) const = 0;
  /// The same without refinement where the factor has lost few digits (`few_digits`): for corrections, and the
  /// compliance of conditions, where the iterations around them correct what is missing.
  virtual void solve_once(Eigen::Ref<Eigen::MatrixXd> rhs) const { solve(rhs); }
  /// rows A^-1 rows^T (m x m) of the last factorised matrix, where that takes much less than m solutions; else an empty
  /// matrix. Exact to the rounding of an unrefined factor. Throws Error `out-of-memory`, `linear-solver`.
  virtual Eigen::MatrixXd compliance(const Eigen::SparseMatrix<double, Eigen::RowMajor>&) const { return {}; }
  /// Whether the compliance costs another factorisation.
  virtual bool factorises_for_compliance() const { return false; }

  /// A backward stable factorisation stays near 1e-16, whatever the condition; at 1e-6 the factors are not those of the
  /// matrix.
  static constexpr double worst_residual = 1e-6;
  /// With so many digits lost, dependent conditions still show as such (unilateral/active_cholesky.hpp).
  static constexpr int few_digits = 3;
};

std::unique_ptr<LinearSolver> make_linear_solver(LinearMethod method, const LinearOptions& options);

/// The fastest method that is safe for the matrix:
///  - a diagonal entry that is not positive (the matrix cannot be positive definite): MUMPS, which pivots;
///  - up to `small_system` rows: Eigen's simplicial LDL^T, part of the program itself;
///  - beyond: CHOLMOD, whose supernodes run on BLAS kernels.
/// docs/linear_solvers.md has the times behind the limit.
LinearMethod choose_method(const SymmetricMatrix& matrix);

/// Below this CHOLMOD's gain is less than the few milliseconds that it takes to load it together with its BLAS.
inline constexpr int small_system = 1000;

}  // namespace comma::solver
