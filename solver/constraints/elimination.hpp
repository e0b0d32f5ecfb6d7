// Kinematic conditions by elimination: u = T q + g. What is symmetric positive definite stays so.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/linear_solver.hpp"
#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Sparse Gauss-Jordan elimination with pivoting on the largest coefficient. Coefficients do not change with time; the
/// right-hand sides do. Redundant relations are found and dropped; a contradictory pair is an error that names both origins.
class Elimination {
 public:
  /// Throws Error `unknown-dof` when a relation uses a component that its node does not carry, naming node, component, origin;
  /// Error `contradictory-conditions` when a relation reads 0 = c.
  Elimination(const DofMap& dofs, std::span<const AppliedLoad> loads);

  int full_size() const;
  int reduced_size() const;
  /// T, full_size x reduced_size.
  const Eigen::SparseMatrix<double>& transformation() const;
  /// g at a time (full_size). Throws Error `contradictory-conditions` naming both origins when redundant relations
  /// disagree at that time by more than `contradiction_tolerance` relative to the largest value involved.
  Eigen::VectorXd offset(double time) const;
  /// The full degree of freedom behind each reduced one (for messages).
  std::span<const int> kept() const;

  /// T^T K T, lower triangle; the pattern depends on K's pattern alone.
  SymmetricMatrix reduce(const SymmetricMatrix& stiffness) const;

 private:
  // to be filled by its implementer
};

}  // namespace comma::solver
