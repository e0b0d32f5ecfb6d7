#include "solver/contact_law/interpolated_step.hpp"

#include "solver/contact_law/support_step.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseColumns = InterpolatedStep::SparseColumns;

/// Products that take about a third as long as the factors of so many multipliers, one of so many.
constexpr Index multipliers_a_product = 200;

}  // namespace

SparseColumns InterpolatedStep::matrix(int height, const std::vector<Entry>& entries) const {
  SparseColumns result(height, unknowns_);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

VectorXd InterpolatedStep::in_lengths(VectorXd all) const {
  all.tail(law_count()).array() /= weights_.array();
  return all;
}

void InterpolatedSolver::take(const InterpolatedStep& step, const SchurComplement& schur) {
  if (version_ == schur.version() && step_ == step) return;
  step_ = step;
  version_ = schur.version();
  all_.reset();
  on_support_.reset();
  without_augmentation_.reset();
}

VectorXd InterpolatedSolver::solve(const InterpolatedStep& step, const SchurComplement& schur, const VectorXd& b) {
  take(step, schur);
  if (const MatrixXd* compliance = schur.kept_compliance(); compliance && compliance->rows() < step.row_count()) {
    if (!on_support_)
      on_support_ = std::make_shared<const SupportStep>(step, schur.on_support(step.rows()), *compliance);
    return on_support_->solve(b, *compliance);
  }
  if (!all_) {
    const Index rows = step.row_count();
    MatrixXd all(step.unknowns(), step.unknowns());
    all.topRows(rows) = -schur.responses(step.rows(), step.forces()).whole();
    all.topLeftCorner(rows, rows).diagonal().array() += 1.0;
    // Laws as lengths: where points are open, multipliers would else be scaled by the area of a face, and what they
    // share with others by its square.
    all.bottomRows(step.law_count()) = step.weights().cwiseInverse().asDiagonal() * step.laws();
    all_.emplace(std::move(all));
  }
  return all_->solve(step.in_lengths(b));
}

/// x that leaves nothing of the laws.
VectorXd InterpolatedSolver::WithoutAugmentation::solve(const VectorXd& of_jumps, const VectorXd& of_laws) const {
  const Index rows = of_jumps.size(), count = of_laws.size();
  VectorXd x(rows + count);
  x.tail(count) = multipliers(of_jumps, of_laws);
  x.head(rows) = of_jumps + by_multipliers * x.tail(count);
  return x;
}

std::optional<VectorXd> InterpolatedSolver::solve_near_last(const InterpolatedStep& step, SchurComplement& schur,
                                                            const VectorXd& b, double tolerance) const {
  const Index rows = step.row_count(), laws = step.law_count();
  const auto most = static_cast<int>(laws / multipliers_a_product);
  if (most < 2 || !without_augmentation_ || version_ != schur.version() || !step_.has_unknowns_of(step) ||
      step_ == step)
    return std::nullopt;
  const SparseColumns forces = step.forces(), law = step.laws(), last_by_multipliers = step_.forces().rightCols(laws);
  const auto product = [&](const VectorXd& x) {
    VectorXd result(rows + laws);
    result << x.head(rows) - schur.times_roughly(step.rows(), forces * x), law * x;
    return step.in_lengths(std::move(result));
  };
  const auto precondition = [&](const VectorXd& lengths) {
    const VectorXd multipliers =
        without_augmentation_->multipliers(lengths.head(rows), lengths.tail(laws).cwiseProduct(step.weights()));
    VectorXd x(rows + laws);
    x << lengths.head(rows) + schur.times_roughly(step.rows(), last_by_multipliers * multipliers), multipliers;
    return x;
  };
  GmresSolution solution =
      solve_gmres(product, precondition, step.in_lengths(b), {.tolerance = tolerance, .most_products = most});
  if (!solution.reached) return std::nullopt;
  return std::move(solution.x);
}

std::optional<VectorXd> InterpolatedSolver::solve_by_products(const InterpolatedStep& step, SchurComplement& schur,
                                                              const VectorXd& b, const GmresOptions& options) {
  const Index rows = step.row_count(), laws = step.law_count();
  if (laws == 0) return std::nullopt;
  if (auto x = solve_near_last(step, schur, b, options.tolerance)) return x;
  take(step, schur);
  if (!without_augmentation_) {
    const SparseColumns forces = step.forces(), law = step.laws(), law_by_jumps = law.leftCols(rows);
    Responses by_multipliers = schur.responses(step.rows(), forces.rightCols(laws));
    DenseLu factor(MatrixXd(law.rightCols(laws)) + by_multipliers.weighed_by(law_by_jumps));
    without_augmentation_.emplace(
        WithoutAugmentation{forces.leftCols(rows), law_by_jumps, std::move(by_multipliers), std::move(factor)});
  }
  const WithoutAugmentation& without = *without_augmentation_;
  const auto left_by = [&](const VectorXd& x) {
    return schur.times_roughly(step.rows(), without.by_jumps * x.head(rows));
  };
  const VectorXd none = VectorXd::Zero(laws);
  VectorXd x = without.solve(b.head(rows), b.tail(laws));
  if (!x.allFinite()) return std::nullopt;
  const VectorXd left = left_by(x);
  if (left.norm() <= options.tolerance * x.head(rows).norm()) return x;
  const GmresSolution solution =
      solve_gmres([&](const VectorXd& jumps) { return VectorXd(jumps - left_by(without.solve(jumps, none))); },
                  [](const VectorXd& jumps) { return jumps; }, left, options);
  if (!solution.reached) return std::nullopt;
  x += without.solve(solution.x, none);
  return x;
}

}  // namespace comma::solver
