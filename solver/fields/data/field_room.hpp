// Fields made from a mesh or a model: room for values, all absent, and how it is filled or given up.
#pragma once

#include <string>
#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// An element field of a model with room for values, all absent: one point a cell, one a node of the cell, or the Gauss
/// points of its element's stresses (of a skin cell: those of its pressure). Without skin, only cells that carry
/// stiffness have room.
ElementField empty_element_field(const Model& model, std::string quantity, Support support,
                                 std::vector<std::string> components, bool skin);
/// The same with one value a cell of the mesh.
ElementField empty_cell_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components);
NodalField empty_nodal_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components);

/// Components X Y Z.
NodalField node_coordinates(const Mesh& mesh);
/// One component with the same value wherever the other field has points.
Field uniform_like(const Field& other, std::string component, double value);

/// Absent values become `value`.
void fill_absent(Field& field, double value);
/// Absent values become zero, and so do components that the field does not name, of stresses (SIEF_R) and strains
/// (EPSI_R) at the points or nodes of elements that know them. What other elements of the model know, and that of the
/// cell does not, stays absent.
void fill_with_zeros(ElementField& field, const Model& model);

/// Takes away the room of cells that have no value at all.
void drop_empty_cells(ElementField& field);

}  // namespace comma::solver
