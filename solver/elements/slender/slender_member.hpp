// One bar or straight beam on two nodes: its place, its section, and its exact stiffness in global axes (R3.08.01).
#pragma once

#include <array>

#include "solver/elements/element_block.hpp"
#include "solver/elements/geometric_stiffness.hpp"
#include "solver/elements/slender/beam_stiffness.hpp"
#include "solver/elements/translation.hpp"

namespace comma::solver {

/// The section of a bar or beam, with the values that the element needs positive. Throws Error `missing-properties`,
/// `invalid-properties`.
const BeamSection& slender_section(const BlockInput& input, int cell);

/// What the stiffness of one element is made from.
struct SlenderMember {
  double length;
  Eigen::Matrix3d axes;  ///< rows: own_axes() with the roll of the section; bars have none
  const BeamSection* section;
  const IsotropicElasticity* material;
};

/// Throws Error as slender_section() and own_axes().
SlenderMember slender_member(const BlockInput& input, int cell);

/// Where the material of a bar or beam is that of the whole: in its middle, with the means of the command variables.
MaterialPoint middle_of(const Mesh& mesh, int cell, const VariableState& state);

/// Of a bar with Dim translations a node.
template <int Dim>
Eigen::Matrix<double, 2 * Dim, 2 * Dim> bar_stiffness(const SlenderMember& member, const IsotropicModuli& material) {
  const Eigen::Matrix<double, Dim, 1> along = member.axes.row(0).template head<Dim>();
  const Eigen::Matrix<double, Dim, Dim> block =
      material.young * member.section->area / member.length * (along * along.transpose());
  Eigen::Matrix<double, 2 * Dim, 2 * Dim> k;
  k << block, -block, -block, block;
  std::array<bool, Dim> invariant;
  invariant.fill(true);
  make_translation_exact<2, Dim>(k, invariant);
  return k;
}

/// What an axial force (positive in tension) adds to it.
template <int Dim>
Eigen::Matrix<double, 2 * Dim, 2 * Dim> bar_geometric_stiffness(const SlenderMember& member, double axial_force) {
  const Eigen::Matrix<double, Dim, Dim> block =
      axial_force / member.length * Eigen::Matrix<double, Dim, Dim>::Identity();
  Eigen::Matrix<double, 2 * Dim, 2 * Dim> k;
  k << block, -block, -block, block;
  return k;
}

/// Of a beam, uniform or with a section that varies; `shears`: Timoshenko's, else Euler's.
BeamMatrix beam_stiffness(const SlenderMember& member, const IsotropicModuli& material, bool shears);

/// What section forces at both ends add to it. Throws Error `unsupported` for a section that varies or is eccentric.
BeamMatrix beam_geometric_stiffness(const SlenderMember& member, const std::array<SectionForces, 2>& ends);

}  // namespace comma::solver
