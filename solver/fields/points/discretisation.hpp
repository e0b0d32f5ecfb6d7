// A field brought to other places: from cells and nodes to Gauss points, and back (CREA_CHAMP, OPERATION='DISC',
// U4.72.04).
#pragma once

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// Values at the nodes of cells or at Gauss points, as `support` says, of the elements of a model, skin elements
/// included where `skin`. One value a cell holds all over it; values at nodes are interpolated by the shape functions
/// of the cell; values at Gauss points are smoothed (to_element_nodes). Elements without a continuum that have one
/// point get the mean of their nodes. One value a cell (Support::cell) is the arithmetic mean of its points or nodes.
/// What the field does not carry at all nodes or points of a cell is absent there. Throws Error `layered-field` for a
/// mean of a field that has several values through the thickness of a plate, `incompatible-field` as to_element_nodes.
ElementField brought_to(const Model& model, const Field& field, Support support, bool skin);

/// Values at nodes: the mean over the cells around each (nodal_means). A model is needed for a field at Gauss points;
/// without one it throws Error `missing-model`.
NodalField brought_to_nodes(const Mesh& mesh, const Model* model, const Field& field);

}  // namespace comma::solver
