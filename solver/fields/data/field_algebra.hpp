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

#include "solver/fields/data/field.hpp"

namespace comma::solver {

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

/// A cell where a given field has other values than a field does, beyond a millionth of the largest of both; empty
/// where there is none.
std::optional<int> cell_of_other_values(const ElementField& field, const ElementField& given);

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
