#include "solver/materials/behaviour/logarithmic_strain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace comma::solver {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The two directions behind each component.
/// Values nearer to each other than this are one in second divided differences: a series about their mean errs by the
/// fourth power, the difference itself by rounding over the distance.
constexpr double near = 1e-3;

/// (e(a) - e(b)) / (a - b) with e(g) = ln(1 + 2 g) / 2.
double first_difference(double a, double b) {
  const double x = 2.0 * (a - b) / (1.0 + 2.0 * b);
  return (x == 0.0 ? 1.0 : std::log1p(x) / x) / (1.0 + 2.0 * b);
}

double second_difference(double a, double b, double c) {
  std::array<double, 3> g{a, b, c};
  std::ranges::sort(g);
  const double mean = (g[0] + g[1] + g[2]) / 3.0;
  const double base = 1.0 / (1.0 + 2.0 * mean);
  if ((g[2] - g[0]) * base > near) return (first_difference(g[2], g[1]) - first_difference(g[1], g[0])) / (g[2] - g[0]);
  // e'' / 2! + e'''' / 4! h2 + e''''' / 5! h3 with the complete symmetric sums h of the distances from the mean.
  Vector3d d(g[0] - mean, g[1] - mean, g[2] - mean);
  d *= 2.0 * base;
  return base * base * (-1.0 - 0.25 * d.squaredNorm() + 0.4 * d.prod());
}

/// The symmetric tensor of a strain component 1 with a shear angle.
Matrix3d basis(int component) {
  Matrix3d t = Matrix3d::Zero();
  const double value = component < 3 ? 1.0 : 0.5;
  t(tensor_row[component], tensor_column[component]) = value;
  t(tensor_column[component], tensor_row[component]) = value;
  return t;
}

}  // namespace

LogarithmicStrain::LogarithmicStrain(const Matrix3d& h) {
  deformation_gradient(h);  // which must not be turned inside out
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(green_lagrange_strain(h));
  values_ = solver.eigenvalues();
  vectors_ = solver.eigenvectors();
  const Vector3d logarithms(0.5 * std::log1p(2.0 * values_[0]), 0.5 * std::log1p(2.0 * values_[1]),
                            0.5 * std::log1p(2.0 * values_[2]));
  strain_ = components_of_stress(vectors_ * logarithms.asDiagonal() * vectors_.transpose());
  strain_.tail<3>() *= 2.0;
  Matrix3d differences;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) differences(i, j) = first_difference(values_[i], values_[j]);
  for (int k = 0; k < 6; ++k) {
    const Matrix3d turned = differences.cwiseProduct(vectors_.transpose() * basis(k) * vectors_);
    projection_.col(k) = components_of_stress(vectors_ * turned * vectors_.transpose());
    projection_.col(k).tail<3>() *= 2.0;
  }
}

Matrix6d LogarithmicStrain::second_tangent(const Matrix6d& d, const Vector6d& t) const {
  Matrix6d tangent = projection_.transpose() * d * projection_;
  const Matrix3d stress = vectors_.transpose() * tensor_of_stress(t) * vectors_;
  std::array<Matrix3d, 6> bases;
  for (int k = 0; k < 6; ++k) bases[k] = vectors_.transpose() * basis(k) * vectors_;
  double weights[3][3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        weights[i][k][j] = second_difference(values_[i], values_[k], values_[j]) * stress(i, j);
  for (int m = 0; m < 6; ++m) {
    for (int n = 0; n <= m; ++n) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          for (int j = 0; j < 3; ++j)
            sum += weights[i][k][j] * (bases[m](i, k) * bases[n](k, j) + bases[n](i, k) * bases[m](k, j));
      tangent(m, n) += sum;
      if (m != n) tangent(n, m) += sum;
    }
  }
  return tangent;
}

}  // namespace comma::solver
