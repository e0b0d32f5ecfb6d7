#include "solver/contact_law/support_step.hpp"

#include <utility>

#include "solver/linear/sparse_products.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseColumns = Eigen::SparseMatrix<double>;

MatrixXd equations(const InterpolatedStep& step, const RowMatrix& rows_on_support, const MatrixXd& compliance) {
  const Index support = rows_on_support.cols(), rows = step.row_count(), laws = step.law_count();
  const SparseColumns forces = step.forces(), law = step.laws(), on_rows(rows_on_support),
                      on_support = on_rows.transpose() * forces;
  MatrixXd result(support + laws, support + laws);
  result.topLeftCorner(support, support) = -product(compliance, SparseColumns(on_support.leftCols(rows) * on_rows));
  result.topLeftCorner(support, support).diagonal().array() += 1.0;
  result.topRightCorner(support, laws) = -product(compliance, SparseColumns(on_support.rightCols(laws)));
  result.bottomLeftCorner(laws, support) = SparseColumns(law.leftCols(rows) * on_rows);
  result.bottomRightCorner(laws, laws) = law.rightCols(laws);
  result.bottomRows(laws).array().colwise() /= step.weights().array();
  return result;
}

}  // namespace

SupportStep::SupportStep(const InterpolatedStep& step, RowMatrix rows, const MatrixXd& compliance)
    : rows_(std::move(rows)),
      forces_(step.forces()),
      laws_(step.laws()),
      weights_(step.weights()),
      system_(equations(step, rows_, compliance)) {}

VectorXd SupportStep::solve(const VectorXd& b, const MatrixXd& compliance) const {
  VectorXd x = solve_once(b, compliance);
  x += solve_once(left(b, x, compliance), compliance);
  return x;
}

VectorXd SupportStep::solve_once(const VectorXd& b, const MatrixXd& compliance) const {
  const Index support = rows_.cols();
  const auto of_jumps = b.head(row_count());
  VectorXd rhs(support + law_count());
  rhs.head(support) = symmetric_product(compliance, rows_.transpose() * (forces_.leftCols(row_count()) * of_jumps));
  rhs.tail(law_count()) = (b.tail(law_count()) - laws_.leftCols(row_count()) * of_jumps).cwiseQuotient(weights_);
  const VectorXd solution = system_.solve(rhs);
  VectorXd x(b.size());
  x.head(row_count()) = of_jumps + rows_ * solution.head(support);
  x.tail(law_count()) = solution.tail(law_count());
  return x;
}

VectorXd SupportStep::left(const VectorXd& b, const VectorXd& x, const MatrixXd& compliance) const {
  VectorXd result = b;
  result.head(row_count()) -=
      x.head(row_count()) - rows_ * symmetric_product(compliance, rows_.transpose() * (forces_ * x));
  result.tail(law_count()) -= laws_ * x;
  return result;
}

}  // namespace comma::solver
