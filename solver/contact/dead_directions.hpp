// Friction where conditions on displacements hold both bodies along the surface.
#pragma once

#include <vector>

#include "solver/contact/condensed_problem.hpp"

namespace comma::solver {

/// A traction along a direction in which both bodies are held (normal to a plane of symmetry) does nothing, and a shear that is its part along the surface does no more than a
/// pressure: the law of the point gets it as its dead one, also where the surface lies askew. Where they are held in two directions there is no friction. `reduced_rows`: those of the points, on the unknowns that conditions leave.
void find_dead_directions(const RowMatrix& reduced_rows, std::vector<CondensedPoint>& points);

}  // namespace comma::solver
