// Friction where conditions on displacements hold both bodies along the surface.
#pragma once

#include <vector>

#include "solver/contact/condensed_contact.hpp"

namespace comma::solver {

/// Along one direction of the surface (on a plane of symmetry) a shear of any size leaves the slip as it is: the law of the point gets it as its dead one. Where conditions hold
/// them along all of the surface there is no friction. `reduced_rows`: those of the points, on the unknowns that conditions leave.
void find_dead_directions(const RowMatrix& reduced_rows, std::vector<CondensedPoint>& points);

}  // namespace comma::solver
