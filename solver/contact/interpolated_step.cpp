#include "solver/contact/interpolated_step.hpp"

#include <algorithm>

#include "solver/linear/dense_solve.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

InterpolatedStep::SparseColumns InterpolatedStep::matrix(Index height, Index width, const Entries& entries) {
  SparseColumns result(height, width);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// S F between unknown rows.
MatrixXd InterpolatedStep::responses(const SchurComplement& schur, const SparseColumns& forces) const {
  MatrixXd result = MatrixXd::Zero(row_count(), forces.cols());
  const bool is_whole = row_count() == schur.size() && std::ranges::is_sorted(rows_);
  for (Index unknown = 0; unknown < forces.cols(); ++unknown)
    for (SparseColumns::InnerIterator force(forces, unknown); force; ++force) {
      const SchurComplement::Column column = schur.column(rows_[static_cast<std::size_t>(force.row())]);
      if (is_whole) result.col(unknown) += force.value() * column;
      else for (int k = 0; k < row_count(); ++k) result(k, unknown) += force.value() * column[rows_[static_cast<std::size_t>(k)]];
    }
  return result;
}

VectorXd InterpolatedStep::solve(const SchurComplement& schur, const VectorXd& b) const {
  MatrixXd all = MatrixXd::Zero(unknowns_, unknowns_);
  all.topRows(row_count()) = -responses(schur, matrix(row_count(), unknowns_, forces_));
  all.topLeftCorner(row_count(), row_count()).diagonal().array() += 1.0;
  for (const Eigen::Triplet<double>& law : laws_) all(row_count() + law.row(), law.col()) += law.value();
  return solve_dense(std::move(all), b);
}

std::optional<VectorXd> InterpolatedStep::solve_by_products(SchurComplement& schur, const VectorXd& b, const GmresOptions& options) const {
  const Index rows = row_count(), laws = law_count();
  if (laws == 0) return std::nullopt;
  const SparseColumns forces = matrix(rows, unknowns_, forces_), law = matrix(laws, unknowns_, laws_);
  const SparseColumns by_jumps = forces.leftCols(rows), law_by_jumps = law.leftCols(rows);
  const MatrixXd by_multipliers = responses(schur, forces.rightCols(laws));
  const DenseLu without_augmentation(MatrixXd(law.rightCols(laws)) + law_by_jumps * by_multipliers);

  // The solution without the forces that jumps bring by themselves leaves these, and nothing of the laws.
  const auto solved_without = [&](const VectorXd& of_jumps, const VectorXd& of_laws) {
    VectorXd x(unknowns_);
    x.tail(laws) = without_augmentation.solve(of_laws - law_by_jumps * of_jumps);
    x.head(rows) = of_jumps + by_multipliers * x.tail(laws);
    return x;
  };
  const auto left_by = [&](const VectorXd& x) { return schur.times_roughly(rows_, by_jumps * x.head(rows)); };
  const VectorXd none = VectorXd::Zero(laws);
  VectorXd x = solved_without(b.head(rows), b.tail(laws));
  if (!x.allFinite()) return std::nullopt;
  const VectorXd left = left_by(x);
  if (left.norm() <= options.tolerance * x.head(rows).norm()) return x;
  const GmresSolution solution = solve_gmres(
      [&](const VectorXd& jumps) { return VectorXd(jumps - left_by(solved_without(jumps, none))); }, [](const VectorXd& jumps) { return jumps; }, left, options);
  if (!solution.reached) return std::nullopt;
  x += solved_without(solution.x, none);
  return x;
}

}  // namespace comma::solver
