// Making fields out of fields: sums, pieces put together, functions of values (CREA_CHAMP, U4.72.04).
//
// A place is a node of a nodal field or a cell of a field on elements; it has one point or several, and a row of values
// at each.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/fields/field.hpp"

namespace comma::solver {

/// An element field of a model with room for values, all absent: one point a cell, one a node of the cell, or the Gauss
/// points of its element's stresses (of a skin cell: those of its pressure). Without skin, only cells that carry
/// stiffness have room.
ElementField empty_element_field(const Model& model, std::string quantity, Support support,
                                 std::vector<std::string> components, bool skin);
/// The same with one value a cell of the mesh.
ElementField empty_cell_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components);
NodalField empty_nodal_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components);

/// The names of the components of a field of either kind.
const std::vector<std::string>& components_of(const Field& field);

/// Components X Y Z.
NodalField node_coordinates(const Mesh& mesh);
/// One component with the same value wherever the other field has points.
Field uniform_like(const Field& other, std::string component, double value);

/// A number made of others that are there: infinite where it is none (a difference of infinite numbers), for NaN says
/// that nothing is there.
inline double made_number(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

/// A value of a field: at a point of a node (0) or cell.
struct FieldEntry {
  int place = 0;
  int point = 0;
  int component = 0;
};
/// The first value that is infinite.
std::optional<FieldEntry> first_infinite(const Field& field);

/// Gives a component one value at all points of the places (all that there are without `places`).
void assign(Field& field, int component, double value, const std::vector<int>* places = nullptr);

/// Absent values become `value`.
void fill_absent(Field& field, double value);
/// Absent values become zero, and so do components that the field does not name, of stresses (SIEF_R) and strains
/// (EPSI_R) at the points or nodes of elements that know them. What other elements of the model know, and that of the
/// cell does not, stays absent.
void fill_with_zeros(ElementField& field, const Model& model);

/// What a cell has, point after point.
std::span<const double> values_of_cell(const ElementField& field, int cell);

/// Whether a cell has a value that is neither zero nor absent.
bool has_other_than_zero(const ElementField& field, int cell);

/// Whether a cell has values, none of them other than zero.
bool is_zero(const ElementField& field, int cell);

/// Takes away the room of cells that have no value at all.
void drop_empty_cells(ElementField& field);

/// The part of a field on some cells, at some nodes.
ElementField on_cells(const ElementField& field, std::span<const int> cells);
NodalField on_nodes(const NodalField& field, std::span<const int> nodes);

/// A cell where a given field has other values than a field does, beyond a millionth of the largest of both; empty
/// where there is none.
std::optional<int> cell_of_other_values(const ElementField& field, const ElementField& given);

/// Two fields that lie on different cells, as one: with the components of both, absent where the other lies; the second
/// alone where the first has no values.
ElementField side_by_side(const ElementField& first, const ElementField& second);

/// The components at these indices, in this order.
Field with_components(const Field& field, std::span<const int> components);

struct FieldTerm {
  const Field* field = nullptr;
  double factor = 1.0;
};
/// The sum of factor times field. A component that a term lacks somewhere adds nothing there; what all lack stays
/// absent, what is no number is infinite (made_number). Throws Error `incompatible-field` for fields that do not lie at
/// the same points.
Field linear_combination(std::span<const FieldTerm> terms);

/// Components `from` of a field, called `to` in the field that receives them; all under their own names when empty.
struct FieldPiece {
  const Field* field = nullptr;
  std::vector<std::string> from;
  std::vector<std::string> to;
  double factor = 1.0;
  bool adds = false;  ///< to what is there, which counts as 0 where absent; else replaces it
};
/// The room of an empty field where the model alone does not say how many points an element has: segments of discrete
/// elements have forces at one end or at both, as their stiffness is. Such cells get the room that the first of the
/// pieces has that are put there (`places`: one list of cells a piece).
void take_room(ElementField& target, const Model& model, std::span<const FieldPiece> pieces,
               std::span<const std::vector<int>> places);

/// Puts a piece into a field at the places (all without `places`). Places that the piece does not carry keep what they
/// have; what is no number becomes infinite (made_number). Throws Error `incompatible-field` (another kind of place,
/// another number of points), `unknown-component`.
void put_piece(Field& target, const FieldPiece& piece, const std::vector<int>* places = nullptr);

/// Takes the values of a field for those that another one has too: of like components, at places with as many points.
/// Throws Error `incompatible-field` for another kind of place.
void take_common_values(Field& target, const Field& source);

/// A function of named values.
struct ValueFunction {
  std::vector<std::string> parameters;
  std::function<double(std::span<const double>)> value;
};
/// At each point the value of the function whose index in `functions` the field `which` has there, its parameters being
/// the components of `arguments` at that point, infinite where it is no number (made_number). Throws Error
/// `incompatible-field` (other places), `missing-variable` naming a parameter that no argument has there, and the node
/// or cell of `mesh`.
Field evaluate(const Mesh& mesh, const Field& which, std::span<const ValueFunction> functions,
               std::span<const Field* const> arguments, std::string quantity);

}  // namespace comma::solver
