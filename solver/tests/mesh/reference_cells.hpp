// The reference cells of R3.01.01 (coordinates of the nodes, volume), for the tests of meshes and their files.
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "solver/mesh/cell_type.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/mesh/reference_cell.hpp"

namespace comma::solver::tests {

using Vector = Eigen::Vector3d;

/// Coordinates of all nodes of the reference cell, in Code_Aster's order.
std::vector<Vector> reference_nodes(CellType type);
/// Length, area or volume of the reference cell; 0 for a point.
double reference_volume(CellType type);

Vector corner_mean(std::span<const Vector> points, int corners);
Vector corner_mean(std::span<const Vector> points, const BoundaryFacet& facet);
/// Area times normal of a facet from its corners.
Vector area_vector(std::span<const Vector> points, const BoundaryFacet& facet);

/// A mesh with one reference cell of each type, each with nodes of its own, set `spacing` apart along x.
Mesh mesh_of_reference_cells(double spacing = 4.0);

/// Volume enclosed by the facets of a solid cell.
double solid_volume(const Mesh& mesh, int cell);

}  // namespace comma::solver::tests
