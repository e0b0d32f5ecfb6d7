// What every linear solver asks of its matrix.
#pragma once

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Throws Error `not-finite` naming the row and column of an entry that is infinite or not a number.
void check_finite(const SymmetricMatrix& matrix);

/// The largest sum of |A_ij| over a row.
double row_sum_norm(const SymmetricMatrix& matrix);

}  // namespace comma::solver
