#include "solver/fields/relation_multipliers.hpp"

#include "solver/fields/nodal_forces.hpp"

namespace comma::solver {

RelationMultipliers::RelationMultipliers(const DofMap& dofs, std::span<const AppliedLoad> loads) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const AppliedLoad& applied : loads)
    for (const LinearRelation& relation : applied.load->relations) {
      const auto column = static_cast<int>(counts_.size());
      counts_.push_back(applied.load->multipliers_per_relation);
      size_ += counts_.back();
      for (const auto& term : relation.terms)
        entries.emplace_back(dofs.dof(term.node, term.component), column, term.coefficient);
    }
  if (counts_.empty()) return;
  Eigen::SparseMatrix<double> transposed(dofs.size(), static_cast<Eigen::Index>(counts_.size()));
  transposed.setFromTriplets(entries.begin(), entries.end());
  factor_ = std::make_unique<const Factor>(transposed);
}

Eigen::VectorXd RelationMultipliers::of(const Eigen::VectorXd& reactions) const {
  Eigen::VectorXd multipliers(size_);
  if (empty()) return multipliers;
  const Eigen::VectorXd sums = factor_->solve(Eigen::VectorXd(-reactions));
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < counts_.size(); next += counts_[k], ++k)
    multipliers.segment(next, counts_[k]).setConstant(sums[static_cast<Eigen::Index>(k)] / std::max(1, counts_[k]));
  return multipliers;
}

std::vector<double> relation_multipliers(const DofMap& dofs, std::span<const AppliedLoad> loads,
                                         const NodalField& reactions) {
  const Eigen::VectorXd found = RelationMultipliers(dofs, loads).of(to_dofs(reactions, dofs));
  return {found.begin(), found.end()};
}

}  // namespace comma::solver
