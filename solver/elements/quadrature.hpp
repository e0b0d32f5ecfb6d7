// Integration families by name, with the order of points of R3.01.01, and which family an element uses for what.
#pragma once

#include <string_view>
#include <vector>

#include "solver/mesh/reference_element.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

struct QuadraturePoint {
  ReferencePoint at{};
  double weight = 0.0;
};

/// Points and weights; the weights add up to reference_measure(type).
using Quadrature = std::vector<QuadraturePoint>;

/// The family `name` ("FPG1", "FPG4" ...) on the reference cell of a type. "NOEU" has its points at the nodes, with
/// equal weights. Throws Error `unknown-family` where the cell has no such family.
Quadrature quadrature(CellType type, std::string_view name);

/// Polynomial degree that a family integrates exactly on straight cells: total degree on triangles, tetrahedra and
/// pyramids, degree in each direction on segments, quadrangles and hexahedra; on pentahedra the smaller of both. -1 for
/// "NOEU".
int quadrature_degree(CellType type, std::string_view name);

/// The family of an element's stiffness and stresses.
std::string_view stiffness_family(CellType type, Formulation formulation);
/// The family of the stiffness and stresses of plates.
std::string_view plate_family(CellType type);
/// The family of its mass, gravity and centrifugal forces included.
std::string_view mass_family(CellType type);
/// The family of pressures and other forces on a skin cell.
std::string_view boundary_family(CellType type);
/// The family of forces on the edge of a solid (FORCE_ARETE; step functions on SEG3 tell its points).
std::string_view edge_family(CellType type);

}  // namespace comma::solver
