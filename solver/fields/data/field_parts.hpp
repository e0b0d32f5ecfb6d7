// Parts of fields: on some cells, at some nodes, of some components; two parts as one field; steps without fields.
#pragma once

#include <span>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// What a cell has, point after point.
std::span<const double> values_of_cell(const ElementField& field, int cell);

/// Whether a cell has a value that is neither zero nor absent.
bool has_other_than_zero(const ElementField& field, int cell);

/// Whether a cell has values, none of them other than zero.
bool is_zero(const ElementField& field, int cell);

/// The part of a field on some cells, at some nodes.
ElementField on_cells(const ElementField& field, std::span<const int> cells);
NodalField on_nodes(const NodalField& field, std::span<const int> nodes);

/// The components at these indices, in this order.
Field with_components(const Field& field, std::span<const int> components);

/// Two fields that lie on different cells, as one: with the components of both, absent where the other lies; the second
/// alone where the first has no values.
ElementField side_by_side(const ElementField& first, const ElementField& second);

/// The order, instant and parameters of a step: what a result has in common with the one that it is made from.
ResultStep without_fields(const ResultStep& step);

}  // namespace comma::solver
