// From Gauss points to the nodes of each element, and from there to the nodes of the mesh.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// Matrix (nodes x points) from the values at the points of a family to those at the nodes of the cell, by local
/// smoothing (R3.06.03): the combination of the linear shape functions of the corners that comes nearest to all points
/// (least squares with equal weights), taken at the nodes, so that a node in the middle of an edge has the mean of its
/// ends. One point: its value everywhere. Throws Error `unknown-family`.
Eigen::MatrixXd gauss_to_nodes(CellType type, std::string_view family);

/// A field at Gauss points as one at element nodes (ELGA to ELNO). Continua are smoothed by their stiffness family;
/// other elements have one point, which holds for all their nodes, or one a node. Throws Error `incompatible-field`
/// naming a cell with another number of points.
ElementField to_element_nodes(const Model& model, const ElementField& field);

/// A nodal field as one at the nodes of each element, skin excluded; cells with a node that carries nothing have none.
ElementField to_element_nodes(const Model& model, const NodalField& field);

/// The arithmetic mean at each node over the cells that give it a value (ELNO to NOEU, U4.81.04); NaN where none does.
/// `cells` restricts the cells that count; none given: all. Throws what require_one_value_a_point does.
NodalField nodal_means(const Mesh& mesh, const ElementField& field, std::optional<std::span<const int>> cells = {});

/// The same over those of the cells that have one value a point. A node of another one carries nothing, as in
/// Code_Aster 17.3. Throws Error `layered-field` where all have several.
NodalField single_valued_means(const Mesh& mesh, const ElementField& field,
                               std::optional<std::span<const int>> cells = {});

/// Those of the cells (none given: all) where a point has several values.
std::vector<int> layered_cells(const ElementField& field, std::optional<std::span<const int>> cells = {});

/// Throws Error `layered-field` naming a cell among `cells` (none given: of all) where a point has several values.
void require_one_value_a_point(const Mesh& mesh, const ElementField& field,
                               std::optional<std::span<const int>> cells = {});

/// The components `names` of a field, on the cells that carry at least one of them.
ElementField select_components(const ElementField& field, std::span<const std::string_view> names);

/// Stresses of continua out of a field of stresses and section forces (SIGM out of SIEF).
ElementField continuum_stresses(const ElementField& field);
/// Section forces of bars, beams, plates and discrete elements (EFGE out of SIEF).
ElementField section_forces(const ElementField& field);

}  // namespace comma::solver
