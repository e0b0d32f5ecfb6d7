// Bars that go on from step to step: whose material flows, or whose geometry is updated.
#pragma once

#include <memory>
#include <vector>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

/// Von Mises plasticity under a stress along the bar alone, in small strains (R5.03.09): with s the stress and X the
/// component of the back stress along the bar it yields at |s - 3/2 X| = R(p), integrated by a return to the yield
/// surface. With Kinematics::updated steps are strained, and forces act, along the bar as it lies at their ends.
/// Internal variables are laid out as in continua (point_law.hpp), tensors having their first component alone. Throws
/// Error `unsupported` for rubber and large strains, and what make_slender_block() does.
std::unique_ptr<ElementBlock> make_inelastic_bar_block(const BlockInput& input, std::vector<int> cells);

}  // namespace comma::solver
