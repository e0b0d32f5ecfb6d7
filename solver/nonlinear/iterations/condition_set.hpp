// All inequalities of a computation at one moment: contact and unilateral conditions, one set of rows.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/definition.hpp"
#include "solver/contact/pairing.hpp"
#include "solver/unilateral/conditions.hpp"
#include "solver/unilateral/inequality.hpp"

namespace comma::solver {

/// A slot is a place for a multiplier that outlives re-pairing: first the pairs (each slave node of each zone, paired
/// or not), then the unilateral conditions node by node.
struct ConditionSet {
  std::vector<ContactPair> pairs;
  Inequalities full;           ///< over all degrees of freedom
  std::vector<int> row_slots;  ///< slot behind each full row
  std::vector<int> row_zones;  ///< its zone of contact, or its unilateral condition
  int slot_count = 0;

  bool empty() const { return full.bounds.size() == 0; }
};

/// Builds the rows from pairs and from the unilateral conditions at a time.
ConditionSet make_conditions(std::vector<ContactPair> pairs, std::span<const UnilateralCondition> unilateral,
                             const Mesh& mesh, const DofMap& dofs, double time);

/// Whether two sets have the same rows and bounds to the last bit.
bool same_rows(const ConditionSet& a, const ConditionSet& b);

/// The reduced unknowns behind all displacements of nodes, rising.
std::vector<int> unknowns_behind(const std::set<int>& nodes, const DofMap& dofs, const Elimination& elimination);

/// "contact of node A with facet M2" or "the unilateral condition -1*DY(A) <= 0".
std::string describe(const ConditionSet& set, int row, const Mesh& mesh, const DofMap& dofs);

/// Error `contradictory-conditions` for rows (of the full set) that cannot hold together, the first being violated.
[[noreturn]] void throw_contradiction(const ConditionSet& set, std::span<const int> rows, const Mesh& mesh,
                                      const DofMap& dofs);

}  // namespace comma::solver
