// Unilateral conditions as rows over the degrees of freedom, and rows as the reduced unknowns see them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/definition.hpp"
#include "solver/model/model.hpp"
#include "solver/unilateral/inequality.hpp"

namespace comma::solver {

/// Rows of LIAISON_UNIL (U4.44.11) at a time: one a condition and node, over all degrees of freedom (DofMap numbering).
/// Throws Error `unknown-dof` where a node lacks a component that its condition uses.
Inequalities unilateral_rows(std::span<const UnilateralCondition> conditions, const Mesh& mesh, const DofMap& dofs,
                             double time);

/// A u <= b with u = T q + g: (A T) q <= b - A g.
struct ReducedInequalities {
  Inequalities inequalities;  ///< over the reduced unknowns
  std::vector<int> origin;    ///< row of the full set behind each reduced row
};

/// Leaves out the rows that the imposed values decide: one that only uses imposed displacements holds, gives way or
/// throws Error `contradictory-conditions`; `describe` names a row of `full` for that message.
ReducedInequalities reduce(const Inequalities& full, const Elimination& elimination, const Eigen::VectorXd& offset,
                           const std::function<std::string(int row)>& describe);

/// A reduced coefficient below this share of the row's largest is what rounding leaves of an eliminated one.
inline constexpr double empty_row_tolerance = 1e-12;

double largest_entry(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, int row);

/// "-1*DY(A) <= 0" for messages.
std::string describe_row(const Inequalities& inequalities, int row, const Mesh& mesh, const DofMap& dofs);

}  // namespace comma::solver
