// The part of numpy that command files use: arrays of numbers of one or two dimensions, computed element by element.
// As in numpy, several arrays may show the same numbers: a[1], a[:, 0] and a.T are windows on those of `a`.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "interpreter/evaluation/meter.hpp"
#include "interpreter/syntax/ast.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

/// numpy's dtypes bool, int64 and float64, in this order: of two, the later holds the numbers of both.
enum class NumberType { boolean, integer, real };
std::string_view name_of(NumberType type);  ///< "float64"

using Shape = std::vector<std::size_t>;
std::size_t size_of(const Shape& shape);
std::string text_of(const Shape& shape);  ///< "(2,3)"

/// Row-major numbers of their own: what functions compute with. A single number has no lengths.
struct Numbers {
  std::vector<double> data;
  Shape shape;
  NumberType type = NumberType::real;
};

/// A window on numbers, which other arrays may show too.
struct ArrayObject : Object {
  std::shared_ptr<std::vector<double>> buffer;
  std::ptrdiff_t offset = 0;  ///< of the first number shown
  Shape shape;                ///< one or two lengths
  std::vector<std::ptrdiff_t> strides;
  NumberType type = NumberType::real;

  std::size_t size() const { return size_of(shape); }
  /// Where the number at this place of the row-major order lies.
  double& at(std::size_t index) const;
  /// Whether the numbers shown lie one after the other.
  bool is_contiguous() const;
  /// A copy of what is shown.
  Numbers numbers() const;
  /// Writes row-major numbers, as many as are shown.
  void write(const std::vector<double>& data);
  /// a[i] with i below the first length: a number, or a window on a row.
  Value row(std::size_t index) const;
  Value to_list() const;  ///< lists of numbers
  std::string type_name() const override { return "numpy.ndarray"; }
  std::string repr() const override;  ///< "array([1., 2.])"
  std::string text() const;           ///< "[1. 2.]"
};

/// A number of an array as Python has it. Raises OverflowError for an integer of which a double may have lost digits.
Value array_number(double value, NumberType type);
/// Numbers brought into a type: cut off to integers, or whether they are not zero. Raises ValueError for nan as
/// integer.
double converted(double value, NumberType type);
Numbers converted(Numbers numbers, NumberType type);

/// Of an array, a number, a sequence of numbers or of equally long ones. Raises ValueError, TypeError for anything
/// else.
Numbers numbers_of(const Value& source, Meter& meter);
/// An array of one or two dimensions, or a plain number where there are no lengths. Raises NotImplementedError for
/// more.
Value make_value(Numbers numbers);
/// Another window on the numbers of an array.
Value make_window(const ArrayObject& array, std::ptrdiff_t offset, Shape shape, std::vector<std::ptrdiff_t> strides);

/// The shape that both are stretched to, as numpy broadcasts. Raises ValueError.
Shape broadcast_shape(const Shape& a, const Shape& b);
/// Row-major numbers stretched to such a shape.
std::vector<double> spread(const Numbers& numbers, const Shape& shape);

/// Element by element, shapes being broadcast; the product of matrices for `@`.
Numbers combine(Operator op, const Numbers& a, const Numbers& b, Meter& meter);
Value array_operation(Operator op, const Value& a, const Value& b, Meter& meter);
/// a += b and its like: written into the numbers that `a` shows, whose type stays. Raises TypeError where it cannot.
void array_update(Operator op, ArrayObject& a, const Value& b, Meter& meter);
/// -a, +a, ~a.
Numbers negated(Operator op, Numbers a);
/// The product of matrices and vectors; np.dot of arrays.
Numbers matrix_product(const Numbers& a, const Numbers& b, Meter& meter);

/// Rows as columns, on the same numbers; a vector is its own.
Value transposed(const ArrayObject& array);

/// a[i], a[i, j], a[i:j], a[:, j]: a number, or a window. An index of booleans or a list of integers gives a copy.
Value array_subscript(const ArrayObject& array, const Value& index, Meter& meter);
/// a[...] = value, stretched to what is selected.
void array_store(ArrayObject& array, const Value& index, const Value& value, Meter& meter);

}  // namespace comma::interpreter
