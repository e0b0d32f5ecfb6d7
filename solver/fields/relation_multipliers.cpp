#include "solver/fields/relation_multipliers.hpp"

#include <Eigen/SparseQR>

#include "solver/fields/nodal_forces.hpp"

namespace comma::solver {

std::vector<double> relation_multipliers(const DofMap& dofs, std::span<const AppliedLoad> loads,
                                         const NodalField& reactions) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> counts;
  for (const AppliedLoad& applied : loads)
    for (const LinearRelation& relation : applied.load->relations) {
      const auto column = static_cast<int>(counts.size());
      counts.push_back(applied.load->multipliers_per_relation);
      for (const auto& term : relation.terms)
        entries.emplace_back(dofs.dof(term.node, term.component), column, term.coefficient);
    }
  if (counts.empty()) return {};
  Eigen::SparseMatrix<double> transposed(dofs.size(), static_cast<Eigen::Index>(counts.size()));
  transposed.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factor(transposed);
  const Eigen::VectorXd sums = factor.solve(Eigen::VectorXd(-to_dofs(reactions, dofs)));
  std::vector<double> multipliers;
  for (std::size_t k = 0; k < counts.size(); ++k)
    multipliers.insert(multipliers.end(), static_cast<std::size_t>(counts[k]),
                       sums[static_cast<Eigen::Index>(k)] / std::max(1, counts[k]));
  return multipliers;
}

}  // namespace comma::solver
