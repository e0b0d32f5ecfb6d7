// A step of Newton's method for contact whose multipliers are interpolated to points between nodes.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/dense_solve.hpp"
#include "solver/linear/gmres.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// The linearised problem of condensed_problem.hpp with jumps d and multipliers as unknowns x together, jumps first: d
/// - S F x = b_d with the forces F x on unknown rows of the compliance S, and the laws L x = b_l, one a multiplier.
class InterpolatedStep {
 public:
  InterpolatedStep() = default;
  /// `rows`: those of S that are unknown.
  InterpolatedStep(std::vector<int> rows, int unknowns)
      : rows_(std::move(rows)), unknowns_(unknowns), weights_(Eigen::VectorXd::Zero(law_count())) {}

  /// Of the force on a row, at its place among the unknown ones. Derivatives by nothing that is unknown (-1) are left
  /// out.
  void add_force_derivative(int place, int unknown, double derivative) { add(forces_, place, unknown, derivative); }
  /// Of the law that is equation `equation` of all.
  void add_law_derivative(int equation, int unknown, double derivative) {
    add(laws_, equation - row_count(), unknown, derivative);
  }
  /// By which the law is a length, as jumps are.
  void add_law_weight(int equation, double weight) { weights_[equation - row_count()] += weight; }

  using SparseColumns = Eigen::SparseMatrix<double>;
  const std::vector<int>& rows() const { return rows_; }
  int unknowns() const { return unknowns_; }
  int row_count() const { return static_cast<int>(rows_.size()); }
  int law_count() const { return unknowns_ - row_count(); }
  SparseColumns forces() const { return matrix(row_count(), forces_); }
  SparseColumns laws() const { return matrix(law_count(), laws_); }
  /// One a law.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// Of what the equations leave, one an unknown: the laws by their weights.
  Eigen::VectorXd in_lengths(Eigen::VectorXd all) const;

  /// Of the equations.
  bool operator==(const InterpolatedStep& other) const {
    return rows_ == other.rows_ && unknowns_ == other.unknowns_ && forces_ == other.forces_ && laws_ == other.laws_;
  }
  bool has_unknowns_of(const InterpolatedStep& other) const {
    return rows_ == other.rows_ && unknowns_ == other.unknowns_;
  }

 private:
  struct Entry {
    int at = 0, unknown = 0;
    double derivative = 0.0;
    int row() const { return at; }
    int col() const { return unknown; }
    double value() const { return derivative; }
    bool operator==(const Entry&) const = default;
  };

  static void add(std::vector<Entry>& entries, int row, int unknown, double derivative) {
    if (derivative != 0.0 && unknown >= 0) entries.push_back({row, unknown, derivative});
  }
  SparseColumns matrix(int height, const std::vector<Entry>& entries) const;

  std::vector<int> rows_;
  int unknowns_ = 0;
  std::vector<Entry> forces_, laws_;
  Eigen::VectorXd weights_;
};

class SupportStep;

/// Solves steps and keeps the factors of the last one: rounds with a compliance that is not exact ask for the same step
/// with other right-hand sides, and the next iteration of Newton's method for one that is little different.
class InterpolatedSolver {
 public:
  /// x for b (one an unknown, jumps first); columns of S must have been required.
  Eigen::VectorXd solve(const InterpolatedStep& step, const SchurComplement& schur, const Eigen::VectorXd& b);
  /// The same for many rows by products with S, in single precision; nothing where the tolerance is not reached. Fast
  /// where multipliers carry most of the forces, and augmentations by jumps little: without them only as many equations
  /// as multipliers are left, which precondition the others.
  std::optional<Eigen::VectorXd> solve_by_products(const InterpolatedStep& step, SchurComplement& schur,
                                                   const Eigen::VectorXd& b, const GmresOptions& options);

 private:
  /// The equations without the forces that jumps bring by themselves.
  struct WithoutAugmentation {
    InterpolatedStep::SparseColumns by_jumps, law_by_jumps;
    Responses by_multipliers;
    DenseLu laws;
    Eigen::VectorXd multipliers(const Eigen::VectorXd& of_jumps, const Eigen::VectorXd& of_laws) const {
      return laws.solve(of_laws - law_by_jumps * of_jumps);
    }
    Eigen::VectorXd solve(const Eigen::VectorXd& of_jumps, const Eigen::VectorXd& of_laws) const;
  };

  /// With the factors at hand for a preconditioner. Nothing where they are of other unknowns, or too much has changed
  /// for new ones to take longer.
  std::optional<Eigen::VectorXd> solve_near_last(const InterpolatedStep& step, SchurComplement& schur,
                                                 const Eigen::VectorXd& b, double tolerance) const;
  void take(const InterpolatedStep& step, const SchurComplement& schur);

  InterpolatedStep step_;
  long version_ = -1;  ///< of S
  std::optional<DenseSystem> all_;
  std::shared_ptr<const SupportStep> on_support_;
  std::optional<WithoutAugmentation> without_augmentation_;
};

}  // namespace comma::solver
