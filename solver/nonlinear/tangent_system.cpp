#include "solver/nonlinear/tangent_system.hpp"

#include <cmath>

#include "solver/constraints/rigid_motion.hpp"
#include "solver/error.hpp"

namespace comma::solver {

TangentSystem::TangentSystem(const Model& model, const DofMap& dofs, const Assembler& assembler,
                             const Elimination& elimination, const NewtonOptions& options, Counters& counters)
    : model_(model), dofs_(dofs), assembler_(assembler), elimination_(elimination), options_(options), counters_(counters) {}

bool TangentSystem::refresh(const Eigen::VectorXd& u) {
  if (factorised_ && assembler_.is_linear() && version_ == assembler_.stiffness_version()) return false;
  if (elimination_.reduced_size() == 0) return false;
  version_ = assembler_.stiffness_version();
  factorise(elimination_.reduce(assembler_.stiffness(u)));
  return true;
}

void TangentSystem::factorise(const SymmetricMatrix& reduced) {
  if (!solver_) solver_ = make_linear_solver(options_.method.value_or(choose_method(reduced)), options_.linear);
  if (!analysed_) solver_->analyse(reduced);
  analysed_ = true;
  FactorReport report = solver_->factorise(reduced);
  ++counters_.factorisations;
  if (report.verdict == FactorVerdict::indefinite && !options_.method && solver_->method() != LinearMethod::mumps) {
    // The choice was ours and it does not pivot: the solver that does takes over.
    solver_ = make_linear_solver(LinearMethod::mumps, options_.linear);
    solver_->analyse(reduced);
    report = solver_->factorise(reduced);
    ++counters_.factorisations;
  }
  // Iterations have no pivots: what moves freely is looked for before they start.
  const int digits = options_.linear.singular_digits;
  if (solver_->method() == LinearMethod::conjugate_gradient &&
      !find_free_parts(*model_.mesh, dofs_, elimination_, reduced, {}, digits).empty()) {
    report.verdict = FactorVerdict::singular;
  }
  if (report.verdict == FactorVerdict::singular) {
    throw singular_matrix_error(*model_.mesh, dofs_, elimination_, reduced, report, digits);
  }
  if (report.verdict == FactorVerdict::indefinite) ++counters_.indefinite_factorisations;
  measure_rows(reduced);
  factorised_ = true;
}

/// Bounds what rounding of u alone does to the residual: a row of |K| times the largest displacement.
void TangentSystem::measure_rows(const SymmetricMatrix& reduced) {
  row_sizes_ = Eigen::VectorXd::Zero(reduced.rows());
  for (int column = 0; column < reduced.outerSize(); ++column)
    for (SymmetricMatrix::InnerIterator it(reduced, column); it; ++it) {
      row_sizes_[it.row()] += std::abs(it.value());
      if (it.row() != column) row_sizes_[column] += std::abs(it.value());
    }
}

void TangentSystem::solve(Eigen::Ref<Eigen::MatrixXd> columns) const {
  if (columns.rows() == 0) return;
  solver_->solve(columns);
  counters_.solves += columns.cols();
}

}  // namespace comma::solver
