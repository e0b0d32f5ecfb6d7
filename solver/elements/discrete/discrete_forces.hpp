// What discrete elements of all kinds share: the names of their forces, and their stiffness.
#pragma once

#include <span>
#include <string_view>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

/// The force and moment components that a discrete element has, in its own axes.
std::span<const std::string_view> discrete_force_names(Formulation formulation);

/// How many of the components at a node are translations.
int discrete_translations(Formulation formulation);

/// The stiffness of the discrete element on a cell. Throws Error `missing-properties`, `wrong-size`.
const DiscreteStiffness& discrete_stiffness(const BlockInput& input, int cell);

/// Throws Error `unsupported` where a cell has another DEFORMATION. `subject`: what knows none, with its verb.
void require_small_displacements(const BlockInput& input, int cell, std::string_view subject);

/// Contact with friction inside discrete elements, in small displacements (Relation::contact_spring). The stiffness of
/// the element holds rotations and, beside friction and whether or not it is closed, displacements across the first own
/// axis, not along it, as Code_Aster 17.3 has it; what touches is the contact spring of its material: between the nodes
/// of a segment, whose gap is the difference of their places less the two distances, or from the node of a point to an
/// obstacle, whose gap is displacement + clearance - first distance. Friction grows from where the gap closes within a
/// step. Internal variables, as Code_Aster 17.3 numbers them: the forces of friction along the second and third own
/// axis, how far they have slid there while closed, three zeros, 1 on a segment and 0 on a point, 1. Throws Error
/// `missing-material`, `missing-properties`, `wrong-size`, `unsupported`.
std::unique_ptr<ElementBlock> make_discrete_contact_block(const BlockInput& input, std::vector<int> cells);

/// Discrete elements whose components have a law each (Relation::bilinear_spring, Relation::hardening_spring), in small
/// displacements; the others keep the stiffness of the element, which must be diagonal in own axes. Internal variables
/// of all six axes: of each 0 where no force acts, 1 on the first slope, 2 on the second; or of each the three of
/// SpringPast. Throws Error `missing-material`, `missing-properties`, `wrong-size`, `invalid-material`,
/// `unsupported`.
std::unique_ptr<ElementBlock> make_discrete_law_block(const BlockInput& input, std::vector<int> cells);

}  // namespace comma::solver
