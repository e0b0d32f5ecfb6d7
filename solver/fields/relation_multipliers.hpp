// The multipliers that a solution with Lagrange multipliers would have (R3.03.01), from one without.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/SparseQR>

#include "solver/fields/data/field.hpp"
#include "solver/loads/load.hpp"

namespace comma::solver {

/// The multipliers of the relations of loads, Load::multipliers_per_relation equal ones for each relation, in their
/// order: B^T times their sums is minus the reactions. Of relations that depend on others some get 0.
class RelationMultipliers {
 public:
  RelationMultipliers(const DofMap& dofs, std::span<const AppliedLoad> loads);

  Eigen::Index size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Of reactions (N and N.m, over all degrees of freedom) of displacements that obey the relations.
  Eigen::VectorXd of(const Eigen::VectorXd& reactions) const;

 private:
  using Factor = Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>>;

  std::vector<int> counts_;  ///< of each relation
  Eigen::Index size_ = 0;
  std::unique_ptr<const Factor> factor_;  ///< null without relations
};

/// Those of reactions as a field DX...
std::vector<double> relation_multipliers(const DofMap& dofs, std::span<const AppliedLoad> loads,
                                         const NodalField& reactions);

}  // namespace comma::solver
