// T^T K T where T only leaves unknowns out: a part of K.
#pragma once

#include <span>
#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// For each row of T (n x m), the column of its only entry, 1, or -1 where it has none; empty if T is not so or if the
/// columns do not rise from row to row.
std::vector<int> selected_unknowns(const Eigen::SparseMatrix<double>& transformation);

/// The rows and columns of K (lower triangle, n x n) whose `unknowns` are not negative, in their order. Takes the
/// memory of K over: a large matrix costs no other.
SymmetricMatrix select_unknowns(SymmetricMatrix&& matrix, std::span<const int> unknowns);

}  // namespace comma::solver
