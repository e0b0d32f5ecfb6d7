// Symmetric scaling of a matrix to a unit diagonal, so that pivots of bodies of any stiffness compare.
#pragma once

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Powers of two s (n) such that S A S has diagonal entries in [1/2, 2). Where the diagonal is zero, the largest entry
/// of the row that lies beside others is brought near 1 as these are scaled, and where the rest of its row dominates
/// the diagonal, the largest entry of the row is (Ruiz, "A scaling algorithm to equilibrate both rows and columns norms
/// in matrices", RAL-TR-2001-034). Being powers of two, they change no digit. A row of zeros gets 1.
Eigen::VectorXd equilibration_factors(const SymmetricMatrix& matrix);

/// S A S.
SymmetricMatrix scaled(const SymmetricMatrix& matrix, const Eigen::VectorXd& factors);

/// The largest magnitude in each row of the full symmetric matrix (n).
Eigen::VectorXd row_maxima(const SymmetricMatrix& matrix);

/// What a pivot of each row is measured against (n): the diagonal's magnitude, or the row's largest entry where that is
/// more than four times as large (a saddle point's zero diagonal is no sign of singularity). 1 for a row of zeros.
Eigen::VectorXd pivot_references(const SymmetricMatrix& matrix);

}  // namespace comma::solver
