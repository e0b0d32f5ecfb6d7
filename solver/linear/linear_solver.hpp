// One interface for all direct solvers of symmetric systems (design: analyse once a pattern, factorise once a stiffness).
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace comma::solver {

/// Symmetric; only the lower triangle is stored, diagonal included (an explicit entry on every row).
using SymmetricMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

enum class LinearMethod : std::uint8_t { mumps, cholmod, eigen_ldlt };
std::string_view name_of(LinearMethod method);

enum class FactorVerdict : std::uint8_t { ok, indefinite, singular };

/// What a factorisation found.
struct FactorReport {
  FactorVerdict verdict = FactorVerdict::ok;
  std::vector<int> null_rows;     ///< rows without a usable pivot (verdict singular)
  int lost_digits = 0;            ///< decimal digits lost on the worst pivot, relative to its initial diagonal
};

struct LinearOptions {
  /// A pivot that loses more decimal digits than this is null (Code_Aster's NPREC); negative: never tested.
  int singular_digits = 8;
  /// Steps of iterative refinement at most, the residual in extended precision.
  int refinement_steps = 3;
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual LinearMethod method() const = 0;
  /// Symbolic analysis of a pattern.
  virtual void analyse(const SymmetricMatrix& matrix) = 0;
  /// Numeric factorisation of a matrix of the analysed pattern; keeps a copy for refinement.
  virtual FactorReport factorise(const SymmetricMatrix& matrix) = 0;
  /// rhs: size n x k, overwritten by the solution. Returns the relative residual |b - A x|_inf / (|A|_inf |x|_inf + |b|_inf)
  /// reached. Throws Error `singular-matrix` if the last factorisation was singular.
  virtual double solve(Eigen::Ref<Eigen::MatrixXd> rhs) const = 0;
};

std::unique_ptr<LinearSolver> make_linear_solver(LinearMethod method, const LinearOptions& options);

}  // namespace comma::solver
