// What the direct solvers share: scaling before, iterative refinement after.
#pragma once

#include <limits>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// What stands in for a pivot that is exactly zero, so that the factorisation goes on and finds the others.
inline constexpr double zero_pivot_shift = std::numeric_limits<double>::epsilon();
/// The digits by which such a pivot is recognised.
inline constexpr int zero_pivot_digits = 14;

/// Factorises S A S (equilibration.hpp) and refines its solutions (refinement.hpp).
class RefinedSolver : public LinearSolver {
 public:
  explicit RefinedSolver(const LinearOptions& options) : options_(options) {}

  void analyse(const SymmetricMatrix& matrix) final;
  FactorReport factorise(const SymmetricMatrix& matrix) final;
  double solve(Eigen::Ref<Eigen::MatrixXd> rhs) const final;
  void solve_once(Eigen::Ref<Eigen::MatrixXd> rhs) const final;

 protected:
  /// Each solver's own part; `matrix` is already scaled, its rows and columns never zero in number. `references` (n):
  /// what each row's pivot is measured against.
  virtual void analyse_pattern(const SymmetricMatrix& matrix) = 0;
  virtual FactorReport factorise_scaled(const SymmetricMatrix& matrix, const Eigen::VectorXd& references) = 0;
  virtual void solve_scaled(Eigen::Ref<Eigen::MatrixXd> rhs) const = 0;
  /// How many digits more than pivots lose a report may name.
  virtual int digits_above_pivots() const { return 0; }

  const LinearOptions& options() const { return options_; }
  const SymmetricMatrix& matrix() const { return matrix_; }
  const Eigen::VectorXd& factors() const { return factors_; }

 private:
  bool has_pattern_of(const SymmetricMatrix& matrix) const;
  void check_not_singular() const;

  LinearOptions options_;
  SymmetricMatrix matrix_;
  Eigen::VectorXd factors_;
  double norm_ = 0.0;
  bool analysed_ = false;
  FactorReport report_;
};

/// The verdict on pivots (n, by row of the matrix): null where a pivot is zero, not finite, or has lost more than
/// `singular_digits` whole decimal digits of its reference; else indefinite where one is negative. Pivots much larger
/// than anything in the scaled matrix show an indefinite matrix factorised without interchanges, on which a small pivot
/// says nothing.
FactorReport judge_pivots(const Eigen::VectorXd& pivots, const Eigen::VectorXd& references, int singular_digits);

}  // namespace comma::solver
