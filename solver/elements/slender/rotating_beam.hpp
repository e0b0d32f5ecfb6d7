// Beams in large displacements and rotations.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

/// Straight beams that turn as far as they like and strain little, step by step on the geometry as it becomes: in a
/// step the end forces in own axes grow by the stiffness of a linear beam of the length that it has at the step's end,
/// times the increments of displacement and rotation of the step in the axes that it has there. Their first
/// direction is the chord's, their second what is left of that of the last step across it, and both are turned about
/// the chord by the mean of the whole rotations of both ends, which the next step does not begin with. A turn by an
/// angle leaves half its square as an elongation: the smaller the steps, the better. So Code_Aster 17.3 does it, as
/// forces and axes (STRX_ELGA, before that turn) of one and several elements tell to all digits, and ssnl139b; R3.08.09
/// says of its like that it assumes small steps. Forces act along the present axes, and their derivative is
/// not symmetric; what stands for it where a symmetric stiffness is asked for is the tangent of Code_Aster 17.3.
/// Internal variables: zero; the roll of the own axes (see own_axes) in radians; the elongation that the turns of all
/// steps have left. Throws Error `unsupported` for sections that vary and materials whose properties do, what
/// make_slender_block() does else.
std::unique_ptr<ElementBlock> make_rotating_beam_block(const BlockInput& input, std::vector<int> cells);

/// Whether a cell is such a beam.
bool is_rotating_beam(Formulation formulation, Kinematics kinematics);
/// Whether any is; `behaviours`: may be null.
bool has_rotating_beams(const Model& model, const BehaviourOfCells* behaviours);

/// Internal variables at each point.
inline constexpr int rotating_beam_variables = 3;

/// Own axes (rows) of such a beam that has moved, from its chord now (first node to second) and its internal variables.
Eigen::Matrix3d rotated_axes(const Eigen::Vector3d& chord, std::span<const double> variables);

}  // namespace comma::solver
