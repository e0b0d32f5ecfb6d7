// The small part of numpy that command files use: arrays of numbers of one or two dimensions, computed element by
// element.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "interpreter/ast.hpp"
#include "interpreter/meter.hpp"
#include "interpreter/value.hpp"

namespace comma::interpreter {

/// A number of an array as Python has it. Raises OverflowError for an integer of which a double may have lost digits.
Value array_number(double value, bool integers);

/// Row-major numbers. `integers` says whether they are shown and read as int, as numpy's dtype would.
struct ArrayObject : Object {
  std::vector<double> data;
  std::vector<std::size_t> shape;  ///< one or two lengths
  bool integers = false;

  /// A list of the items, or of the rows (arrays themselves).
  Value rows() const;
  Value item(std::size_t index) const;  ///< of the flat data
  Value to_list() const;                ///< lists of numbers
  std::string type_name() const override { return "numpy.ndarray"; }
  std::string repr() const override;
};

/// From a number sequence, or a sequence of equally long ones. Raises ValueError, TypeError for anything else.
Value make_array(const Value& source, Meter& meter);
Value make_array(std::vector<double> data, std::vector<std::size_t> shape, bool integers);

/// Element by element, a number standing for an array of it. Comparisons give arrays of 0 and 1.
Value array_operation(Operator op, const Value& a, const Value& b, Meter& meter);

/// Rows as columns; a vector is its own.
Value transposed(const ArrayObject& array);

/// a[i], a[i, j], a[i:j], a[:, j].
Value array_subscript(const ArrayObject& array, const Value& index);
void array_store(ArrayObject& array, const Value& index, const Value& value);

}  // namespace comma::interpreter
