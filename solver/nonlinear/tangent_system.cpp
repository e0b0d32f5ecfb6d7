#include "solver/nonlinear/tangent_system.hpp"

#include <algorithm>
#include <cmath>

#include "solver/constraints/rigid_motion.hpp"
#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Beyond, the rounding of squares hides what holds a body.
constexpr int most_gram_digits = 15;

}  // namespace

TangentSystem::TangentSystem(const Model& model, const DofMap& dofs, const Assembler& assembler,
                             const Elimination& elimination, const NewtonOptions& options, Counters& counters)
    : model_(model), dofs_(dofs), assembler_(assembler), elimination_(elimination), options_(options), counters_(counters) {}

bool TangentSystem::refresh(const Eigen::VectorXd& u) {
  if (factorised_ && assembler_.is_linear() && version_ == assembler_.stiffness_version()) return false;
  if (elimination_.reduced_size() == 0) return false;
  version_ = assembler_.stiffness_version();
  const SymmetricMatrix reduced = elimination_.reduce(assembler_.stiffness(u));
  if (assembler_.is_symmetric())
    factorise(reduced);
  else
    factorise(reduced, elimination_.reduce_skew(assembler_.skew_stiffness(u)));
  measure_rows(reduced);
  factorised_ = true;
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
}

void TangentSystem::factorise(const SymmetricMatrix& reduced, const SkewMatrix& skew) {
  if (options_.method == LinearMethod::conjugate_gradient) {
    throw Error("unsupported", "conjugate gradients need a symmetric stiffness, and here an element has an unsymmetric one",
                "choose a direct solver");
  }
  if (!unsymmetric_) unsymmetric_ = std::make_unique<UnsymmetricSolver>(options_.linear);
  const FactorReport report = unsymmetric_->factorise(reduced, skew);
  ++counters_.factorisations;
  if (report.verdict != FactorVerdict::singular) return;
  // Energies are those of K^T K, where a support's digits count twice.
  const int digits = std::min(2 * std::max(0, options_.linear.singular_digits), most_gram_digits);
  throw singular_matrix_error(*model_.mesh, dofs_, elimination_, gram_matrix(full_matrix(reduced, skew)), report, digits);
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
  if (unsymmetric_)
    unsymmetric_->solve(columns);
  else
    solver_->solve(columns);
  counters_.solves += columns.cols();
}

}  // namespace comma::solver
