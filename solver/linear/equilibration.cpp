#include "solver/linear/equilibration.hpp"

#include <cmath>

namespace comma::solver {

namespace {

/// In a positive definite matrix of unit diagonal no entry exceeds 1; powers of two blur that by a factor of 2.
constexpr double dominated = 4.0;
/// Each pass halves the exponents' spread; eight bring 1e300 to within a factor of about 10.
constexpr int most_passes = 8;

double power_of_two_near(double value) { return std::ldexp(1.0, static_cast<int>(std::lround(std::log2(value)))); }

/// Rows without a diagonal entry go by what their entries become in the columns of the others.
Eigen::VectorXd diagonal_factors(const SymmetricMatrix& matrix) {
  const Eigen::VectorXd diagonal = matrix.diagonal(), maxima = row_maxima(matrix);
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(matrix.rows());
  for (Eigen::Index row = 0; row < factors.size(); ++row)
    if (diagonal[row] != 0.0) factors[row] = power_of_two_near(1.0 / std::sqrt(std::abs(diagonal[row])));
  Eigen::VectorXd beside = Eigen::VectorXd::Zero(matrix.rows());
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SymmetricMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const double size = std::abs(entry.value());
      if (diagonal[column] != 0.0) beside[entry.row()] = std::max(beside[entry.row()], size * factors[column]);
      if (diagonal[entry.row()] != 0.0) beside[column] = std::max(beside[column], size * factors[entry.row()]);
    }
  }
  for (Eigen::Index row = 0; row < factors.size(); ++row) {
    if (diagonal[row] != 0.0) continue;
    if (beside[row] > 0.0)
      factors[row] = power_of_two_near(1.0 / beside[row]);
    else if (maxima[row] > 0.0)
      factors[row] = power_of_two_near(1.0 / std::sqrt(maxima[row]));
  }
  return factors;
}

}  // namespace

Eigen::VectorXd row_maxima(const SymmetricMatrix& matrix) {
  Eigen::VectorXd maxima = Eigen::VectorXd::Zero(matrix.rows());
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SymmetricMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const double size = std::abs(entry.value());
      maxima[entry.row()] = std::max(maxima[entry.row()], size);
      maxima[column] = std::max(maxima[column], size);
    }
  }
  return maxima;
}

SymmetricMatrix scaled(const SymmetricMatrix& matrix, const Eigen::VectorXd& factors) {
  SymmetricMatrix result = matrix;
  for (int column = 0; column < result.outerSize(); ++column) {
    for (SymmetricMatrix::InnerIterator entry(result, column); entry; ++entry) {
      entry.valueRef() *= factors[entry.row()] * factors[column];
    }
  }
  return result;
}

Eigen::VectorXd equilibration_factors(const SymmetricMatrix& matrix) {
  Eigen::VectorXd factors = diagonal_factors(matrix);
  for (int pass = 0; pass < most_passes; ++pass) {
    const Eigen::VectorXd maxima = row_maxima(scaled(matrix, factors));
    if (maxima.size() == 0 || maxima.maxCoeff() <= dominated) break;
    for (Eigen::Index row = 0; row < factors.size(); ++row) {
      if (maxima[row] > 0.0) factors[row] *= power_of_two_near(1.0 / std::sqrt(maxima[row]));
    }
  }
  return factors;
}

Eigen::VectorXd pivot_references(const SymmetricMatrix& matrix) {
  const Eigen::VectorXd maxima = row_maxima(matrix);
  Eigen::VectorXd references = matrix.diagonal().cwiseAbs();
  for (Eigen::Index row = 0; row < references.size(); ++row) {
    if (maxima[row] > dominated * references[row]) references[row] = maxima[row];
    if (references[row] == 0.0) references[row] = 1.0;
  }
  return references;
}

}  // namespace comma::solver
