// How much more than its area alone a box section of moderate walls shears under a force across a beam.
#pragma once

#include <optional>

namespace comma::solver {

/// The area over the reduced area of a hollow rectangle (A_Y, A_Z of U4.42.01) by the ratios of the inner to the outer
/// size along the force and across it. So has it Code_Aster 17.3, whatever the outline: the energy of Saint-Venant's
/// stresses in a square one (shear_coefficient_along_z(), to 3e-3), with five digits at 12 by 12 ratios, and linear in
/// each ratio between them. Nothing for ratios above 0.95, which 17.3 refuses.
std::optional<double> box_shear(double along, double across);

}  // namespace comma::solver
