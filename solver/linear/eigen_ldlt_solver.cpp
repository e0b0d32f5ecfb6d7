#include "solver/linear/eigen_ldlt_solver.hpp"

#include <algorithm>
#include <limits>

#include "solver/linear/refined_solver.hpp"

namespace comma::solver {

namespace {

class EigenLdltSolver final : public RefinedSolver {
 public:
  using RefinedSolver::RefinedSolver;

  LinearMethod method() const override { return LinearMethod::eigen_ldlt; }

 protected:
  void analyse_pattern(const SymmetricMatrix& matrix) override { factors_.analyzePattern(matrix); }

  FactorReport factorise_scaled(const SymmetricMatrix& matrix, const Eigen::VectorXd& references) override {
    int digits = options().singular_digits;
    factors_.setShift(0.0, 1.0);
    factors_.factorize(matrix);
    if (factors_.info() != Eigen::Success) {
      factors_.setShift(zero_pivot_shift, 1.0);
      factors_.factorize(matrix);
      digits = digits < 0 ? zero_pivot_digits : std::min(digits, zero_pivot_digits);
    }
    return judge_pivots(pivots_by_row(), references, digits);
  }

  void solve_scaled(Eigen::Ref<Eigen::MatrixXd> rhs) const override { rhs = factors_.solve(rhs).eval(); }

 private:
  Eigen::VectorXd pivots_by_row() const {
    const auto& order = factors_.permutationP();
    if (order.size() == 0) return factors_.vectorD();
    Eigen::VectorXd pivots(order.size());
    for (Eigen::Index row = 0; row < pivots.size(); ++row) pivots[row] = factors_.vectorD()[order.indices()[row]];
    return pivots;
  }

  Eigen::SimplicialLDLT<SymmetricMatrix, Eigen::Lower> factors_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_eigen_ldlt_solver(const LinearOptions& options) {
  return std::make_unique<EigenLdltSolver>(options);
}

}  // namespace comma::solver
