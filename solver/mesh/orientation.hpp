// Turning skin cells so that their normals point out of the bodies they bound (MODI_MAILLAGE ORIE_PEAU, U4.23.04).
#pragma once

#include <span>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Turns each of the skin cells so that its normal points out of the volume (or plane) cell behind it. `support` limits the
/// search to those cells; empty: all cells of one dimension more. Returns how many were turned. Throws Error
/// `skin-without-support` naming a cell that bounds nothing, `skin-inside-body` one that lies between two cells of the
/// support.
int orient_skin(Mesh& mesh, std::span<const int> skin, std::span<const int> support = {});

/// Those of the skin cells whose normals point into the body behind them. Cells that bound no body, or lie between two, have
/// no outer side and are left out.
std::vector<int> inward_skin(const Mesh& mesh, std::span<const int> skin);

}  // namespace comma::solver
