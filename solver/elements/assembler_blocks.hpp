// What the files of Assembler share: its blocks, and sums over them.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "solver/elements/assembler.hpp"
#include "solver/elements/element_block.hpp"
#include "solver/elements/solids/imposed_strains.hpp"
#include "solver/elements/sparse_pattern.hpp"

namespace comma::solver {

inline std::vector<double> stresses_of(const ElementBlock& block, const Eigen::VectorXd& u, const VariableState& state,
                                       const ImposedStrains* imposed) {
  std::vector<double> values(block.cells().size() * static_cast<std::size_t>(block.point_count()) *
                             block.stress_names().size());
  block.stresses(u, state, values);
  if (imposed != nullptr && !imposed->empty()) block.subtract_imposed_stresses(*imposed, state, values);
  return values;
}

inline Eigen::VectorXd rounded(const std::vector<long double>& sums) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(sums.size()));
  std::transform(sums.begin(), sums.end(), result.data(), [](long double sum) { return static_cast<double>(sum); });
  return result;
}

struct Assembler::Blocks {
  using StiffnessTerm = void (ElementBlock::*)(const Eigen::VectorXd&, const VariableState&, std::span<const int>,
                                               double*) const;
  using ForceTerm = void (ElementBlock::*)(const Eigen::VectorXd&, const VariableState&, ForceSum) const;

  SparsePattern pattern;
  std::vector<std::unique_ptr<ElementBlock>> list;

  SymmetricMatrix sum(StiffnessTerm add, const Eigen::VectorXd& u, const VariableState& state) const {
    SymmetricMatrix matrix = pattern.zero_matrix();
    for (const auto& block : list) ((*block).*add)(u, state, pattern.column_starts(), matrix.valuePtr());
    return matrix;
  }
  Eigen::VectorXd sum(ForceTerm add, const Eigen::VectorXd& u, const VariableState& state) const {
    std::vector<long double> sums(static_cast<std::size_t>(u.size()), 0.0L);
    for (const auto& block : list) ((*block).*add)(u, state, sums);
    return rounded(sums);
  }
  /// By the strict lower triangle, of the blocks that `is_unsymmetric` picks.
  template <class Pick>
  SkewMatrix skew_sum(const Eigen::VectorXd& u, const VariableState& state, Pick&& is_unsymmetric) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& block : list)
      if (is_unsymmetric(*block)) block->add_skew_stiffness(u, state, entries);
    SkewMatrix matrix(u.size(), u.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
};

}  // namespace comma::solver
