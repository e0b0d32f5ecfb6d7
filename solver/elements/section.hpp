// What discrete and slender elements have beside their mesh: stiffnesses, sections, orientations.
#pragma once

#include <span>
#include <unordered_map>

#include <Eigen/Dense>

#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The stiffness of a discrete element, in global axes already: on a point k x k, on a segment 2k x 2k, k components a node.
struct DiscreteStiffness {
  Eigen::MatrixXd matrix;
  /// Rows: the element's own axes, in which its forces N, VY, VZ ... are given.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// In which axes the values of a discrete stiffness are given.
enum class DiscreteFrame : std::uint8_t { global, local };

/// Own axes (rows) of a cell: a segment's first axis runs from its first node to its second, its second axis lies in the plane of
/// the first and the global Y, or X where the segment is parallel to Z (nautical angles without a roll, U4.42.01); a point has
/// the global axes. Throws Error `distorted-cell` for a segment without length.
Eigen::Matrix3d discrete_axes(const Mesh& mesh, int cell);

/// Components that the element of a discrete formulation has at each node.
int discrete_components(Formulation formulation);

/// From one value a component: on a point diag(values); on a segment [D -D; -D D] with D = diag(values) (U4.42.01, K_T_D_N,
/// K_TR_D_N, K_T_D_L, K_TR_D_L). Throws Error `wrong-size` unless there is one value for each component of the formulation.
DiscreteStiffness diagonal_stiffness(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values,
                                     DiscreteFrame frame);

/// From the upper triangle of the symmetric matrix, column by column, k (k+1) / 2 values with k the number of components on a
/// point, twice that on a segment (U4.42.01, K_T_N, K_TR_N, K_T_L, K_TR_L).
DiscreteStiffness symmetric_stiffness(const Mesh& mesh, int cell, Formulation formulation, std::span<const double> values,
                                      DiscreteFrame frame);

/// Characteristics by cell index.
struct ElementProperties {
  std::unordered_map<int, DiscreteStiffness> discrete;
};

}  // namespace comma::solver
