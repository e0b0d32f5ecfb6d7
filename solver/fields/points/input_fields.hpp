// What a computation is given, seen as fields: the data of plates, the forces and pressures of a load.
#pragma once

#include "solver/elements/slender/section.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/loads/load.hpp"

namespace comma::solver {

using PlateSections = std::unordered_map<int, PlateSection>;  ///< by cell

/// One value a plate: EP (thickness), ALPHA and BETA (the angles of its first axis about Z, then about Y, in degrees),
/// CTOR (drilling), EXCENT (offset), KAPPA (shear factor).
ElementField plate_data(const Mesh& mesh, const PlateSections& plates);

/// COQ_NCOU: the number of layers in the thickness of a plate.
ElementField layer_counts(const Mesh& mesh, const PlateSections& plates);

/// FX FY FZ of the distributed forces on the cells of one dimension, summed where several act. Throws Error
/// `unsupported` for a force that a function gives.
ElementField force_data(const Mesh& mesh, const Load& load, int cell_dimension);

/// PRES and CISA, summed where several act. Throws Error `unsupported` for a pressure that a function gives.
ElementField pressure_data(const Mesh& mesh, const Load& load);

}  // namespace comma::solver
