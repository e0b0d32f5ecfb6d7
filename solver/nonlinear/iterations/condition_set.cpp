#include "solver/nonlinear/iterations/condition_set.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "solver/contact/gap.hpp"
#include "solver/error.hpp"
#include "solver/linear/row_matrix.hpp"

namespace comma::solver {
namespace {

Inequalities stacked(const Inequalities& upper, const Inequalities& lower) {
  Inequalities result;
  const Eigen::Index shift = upper.rows.rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < upper.rows.outerSize(); ++row)
    for (RowMatrix::InnerIterator it(upper.rows, row); it; ++it) entries.emplace_back(row, it.col(), it.value());
  for (int row = 0; row < lower.rows.outerSize(); ++row)
    for (RowMatrix::InnerIterator it(lower.rows, row); it; ++it)
      entries.emplace_back(shift + row, it.col(), it.value());
  result.rows.resize(shift + lower.rows.rows(), upper.rows.cols());
  result.rows.setFromTriplets(entries.begin(), entries.end());
  result.bounds.resize(result.rows.rows());
  result.bounds << upper.bounds, lower.bounds;
  result.sizes = Eigen::VectorXd::Zero(result.rows.rows());
  if (upper.sizes.size()) result.sizes.head(shift) = upper.sizes;
  if (lower.sizes.size()) result.sizes.tail(lower.rows.rows()) = lower.sizes;
  result.softness = Eigen::VectorXd::Zero(result.rows.rows());
  if (upper.softness.size()) result.softness.head(shift) = upper.softness;
  if (lower.softness.size()) result.softness.tail(lower.rows.rows()) = lower.softness;
  return result;
}

}  // namespace

ConditionSet make_conditions(std::vector<ContactPair> pairs, std::span<const UnilateralCondition> unilateral,
                             const Mesh& mesh, const DofMap& dofs, double time) {
  ConditionSet set;
  set.pairs = std::move(pairs);
  const Inequalities gaps = gap_rows(set.pairs, mesh, dofs, set.row_slots);
  const Inequalities bounds = unilateral_rows(unilateral, mesh, dofs, time);
  if (!bounds.bounds.allFinite())
    throw Error("not-finite",
                fmt::format("a bound of a unilateral condition is infinite or not a number at t = {:.6g}", time),
                "look at the function of COEF_IMPO");
  set.full = stacked(gaps, bounds);
  const int pair_count = static_cast<int>(set.pairs.size());
  for (const int slot : set.row_slots) set.row_zones.push_back(set.pairs[static_cast<std::size_t>(slot)].zone);
  for (int row = 0; row < static_cast<int>(bounds.bounds.size()); ++row) set.row_slots.push_back(pair_count + row);
  for (std::size_t k = 0; k < unilateral.size(); ++k)
    set.row_zones.insert(set.row_zones.end(), unilateral[k].nodes.size(), static_cast<int>(k));
  set.slot_count = pair_count + static_cast<int>(bounds.bounds.size());
  return set;
}

bool same_rows(const ConditionSet& a, const ConditionSet& b) {
  return a.row_slots == b.row_slots && a.full.bounds == b.full.bounds && a.full.softness == b.full.softness &&
         same_matrix(a.full.rows, b.full.rows);
}

std::vector<int> unknowns_behind(const std::set<int>& nodes, const DofMap& dofs, const Elimination& elimination) {
  std::set<int> unknowns;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> transformation = elimination.transformation();
  for (const int node : nodes)
    for (int component = 0; component < component_count; ++component) {
      const int dof = dofs.dof(node, static_cast<Component>(component));
      if (dof < 0) continue;
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(transformation, dof); it; ++it)
        unknowns.insert(static_cast<int>(it.col()));
    }
  return {unknowns.begin(), unknowns.end()};
}

std::string describe(const ConditionSet& set, int row, const Mesh& mesh, const DofMap& dofs) {
  const int slot = set.row_slots[row];
  if (slot >= static_cast<int>(set.pairs.size()))
    return "the unilateral condition " + describe_row(set.full, row, mesh, dofs);
  const ContactPair& pair = set.pairs[slot];
  return fmt::format("the contact of node {} with facet {}", mesh.node_name(pair.slave), mesh.cell_name(pair.facet));
}

void throw_contradiction(const ConditionSet& set, std::span<const int> rows, const Mesh& mesh, const DofMap& dofs) {
  constexpr std::size_t shown = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(shown, rows.size()); ++i)
    names += (i == 0 ? "" : "; ") + describe(set, rows[i], mesh, dofs);
  if (rows.size() > shown) names += fmt::format("; and {} more", rows.size() - shown);
  throw Error("contradictory-conditions", "these conditions cannot hold together: " + names,
              "loosen one of the bounds, or check the signs of coefficients and bounds");
}

}  // namespace comma::solver
