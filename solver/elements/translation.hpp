// Making a body's rigid translation cost exactly nothing.
//
// A body of stiffness 1e9 that springs of stiffness 10 hold is found where the springs want it only if the body itself
// resists a translation by less than 10 times the accuracy wanted. Rounding alone gives the rows of its stiffness a sum
// of some 1e-16 * 1e9. Two measures remove it:
//
//  - element matrices are rounded to multiples of a power of two, `translation_bits` binary places below their largest
//  entry (of like units),
//    and the rows and columns of the last node are set to minus the sum of the others. All these sums are exact, and so
//    are those of assembly as long as the elements around a node differ in stiffness by less than 2^(53 -
//    translation_bits). The perturbation, 2^-49 of the largest entry, is of the size of the rounding that integration
//    causes anyway;
//  - internal forces come from displacements relative to the element's last node, and the force on that node is minus
//  the sum of
//    the others in extended precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

namespace comma::solver {

inline constexpr int translation_bits = 48;

/// Rounds the entries that make_translation_exact() sums: those of two invariant directions, and those of one and
/// another degree of freedom, which may have another unit (a rotation) and so have a grid of their own.
template <int Nodes, int Dim>
void round_translations(Eigen::Matrix<double, Nodes * Dim, Nodes * Dim>& k, const std::array<bool, Dim>& invariant) {
  const auto kind = [&](int i, int j) {
    return static_cast<std::size_t>(invariant[i % Dim]) + static_cast<std::size_t>(invariant[j % Dim]);
  };
  std::array<double, 3> shifts{};  // by how many of the two are invariant
  for (int j = 0; j < Nodes * Dim; ++j)
    for (int i = 0; i < Nodes * Dim; ++i) shifts[kind(i, j)] = std::max(shifts[kind(i, j)], std::abs(k(i, j)));
  // Adding and taking away 1.5 * 2^52 grids leaves the nearest multiple of the grid.
  for (double& each : shifts) each = each > 0.0 ? std::ldexp(1.5, std::ilogb(each) + 1 - translation_bits + 52) : 0.0;
  shifts[0] = 0.0;
  for (int j = 0; j < Nodes * Dim; ++j)
    for (int i = 0; i < Nodes * Dim; ++i) k(i, j) = (k(i, j) + shifts[kind(i, j)]) - shifts[kind(i, j)];
}

/// Gives a symmetric element matrix (dof a * Dim + c for node a, direction c) row sums that are exactly zero in every
/// direction d with invariant[d] (a rigid translation along d strains nothing). Both triangles in and out.
template <int Nodes, int Dim>
void make_translation_exact(Eigen::Matrix<double, Nodes * Dim, Nodes * Dim>& k,
                            const std::array<bool, Dim>& invariant) {
  if (!(k.diagonal().cwiseAbs().maxCoeff() > 0.0) || !k.diagonal().allFinite()) return;
  round_translations<Nodes, Dim>(k, invariant);
  constexpr int last = (Nodes - 1) * Dim;
  for (int d = 0; d < Dim; ++d) {
    if (!invariant[d]) continue;
    for (int row = 0; row < last; ++row) {
      double sum = 0.0;
      for (int b = 0; b < Nodes - 1; ++b) sum += k(row, b * Dim + d);
      k(row, last + d) = -sum;
      k(last + d, row) = -sum;
    }
  }
  for (int d = 0; d < Dim; ++d) {
    if (!invariant[d]) continue;
    for (int c = 0; c < Dim; ++c) {
      double sum = 0.0;
      for (int b = 0; b < Nodes - 1; ++b) sum += k(last + c, b * Dim + d);
      k(last + c, last + d) = -sum;
      k(last + d, last + c) = -sum;
    }
  }
}

}  // namespace comma::solver
