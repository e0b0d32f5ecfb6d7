// A step of Newton's method for contact whose multipliers are interpolated to points between nodes.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/gmres.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// The linearised problem of condensed_problem.hpp with jumps d and multipliers as unknowns x together, jumps first: d - S F x = b_d with the forces F x on
/// unknown rows of the compliance S, and the laws L x = b_l, one a multiplier.
class InterpolatedStep {
 public:
  /// `rows`: those of S that are unknown; must outlive the step.
  InterpolatedStep(const std::vector<int>& rows, int unknowns) : rows_(rows), unknowns_(unknowns) {}

  /// Of the force on a row, at its place among the unknown ones. Derivatives by nothing that is unknown (-1) are left out.
  void add_force_derivative(int place, int unknown, double derivative) { add(forces_, place, unknown, derivative); }
  /// Of the law that is equation `equation` of all.
  void add_law_derivative(int equation, int unknown, double derivative) { add(laws_, equation - row_count(), unknown, derivative); }

  /// x for b (one an unknown, jumps first); columns of S must have been required.
  Eigen::VectorXd solve(const SchurComplement& schur, const Eigen::VectorXd& b) const;
  /// The same for many rows by products with S, in single precision; nothing where the tolerance is not reached. Fast where multipliers carry most of the forces, and
  /// augmentations by jumps little: without them only as many equations as multipliers are left, which precondition the others.
  std::optional<Eigen::VectorXd> solve_by_products(SchurComplement& schur, const Eigen::VectorXd& b, const GmresOptions& options) const;

 private:
  using Entries = std::vector<Eigen::Triplet<double>>;
  using SparseColumns = Eigen::SparseMatrix<double>;

  int row_count() const { return static_cast<int>(rows_.size()); }
  int law_count() const { return unknowns_ - row_count(); }
  static void add(Entries& entries, int row, int unknown, double derivative) {
    if (derivative != 0.0 && unknown >= 0) entries.emplace_back(row, unknown, derivative);
  }
  static SparseColumns matrix(Eigen::Index height, Eigen::Index width, const Entries& entries);
  Eigen::MatrixXd responses(const SchurComplement& schur, const SparseColumns& forces) const;

  const std::vector<int>& rows_;
  const int unknowns_;
  Entries forces_, laws_;
};

}  // namespace comma::solver
