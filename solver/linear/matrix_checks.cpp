#include "solver/linear/matrix_checks.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

double row_sum_norm(const SymmetricMatrix& matrix) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(matrix.rows());
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SymmetricMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      sums[entry.row()] += std::abs(entry.value());
      if (entry.row() != column) sums[column] += std::abs(entry.value());
    }
  }
  return sums.size() == 0 ? 0.0 : sums.maxCoeff();
}

void check_finite(const SymmetricMatrix& matrix) {
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SymmetricMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      if (std::isfinite(entry.value())) continue;
      throw Error("not-finite",
                  fmt::format("the matrix has the entry {} at row {}, column {}", entry.value(), entry.row(), column),
                  "look for a material constant, a section or a coordinate that is zero, infinite or missing");
    }
  }
}

}  // namespace comma::solver
