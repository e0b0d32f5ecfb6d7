// Fields of one mesh at places of another: what shape functions make of them there (PROJ_CHAMP, METHODE='COLLOCATION';
// U4.72.05).
#pragma once

#include <span>
#include <vector>

#include "solver/constraints/embedding.hpp"
#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// The cells of the highest dimension that carry elements: those in which places are looked for.
std::vector<int> bulk_cells(const Model& model);
/// Of a mesh alone: its cells of the highest dimension.
std::vector<int> bulk_cells(const Mesh& mesh);
/// Of some cells those of the highest dimension among them.
std::vector<int> highest_cells(const Mesh& mesh, std::span<const int> cells);

/// The field at places, each a point of the cell that is its host: row i of the result is that of `hosts[i]`. Absent
/// without a host (`cell` -1), and of components that a node with a part in the place does not carry.
NodalField at_places(const Mesh& mesh, const NodalField& field, std::span<const Embedding> hosts);
/// The same of a field at the nodes of elements, as the host has it. Throws Error `incompatible-field` for another.
NodalField at_places(const ElementField& field, std::span<const Embedding> hosts);

}  // namespace comma::solver
