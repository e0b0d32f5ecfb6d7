// The values of the command language: Python's None, bool, int, float, complex, str, tuple, list, dict, functions, and
// the two things of its own: _F(...) occurrences and handles on concepts. Copying a Value is cheap.
#pragma once

#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/concept.hpp"
#include "interpreter/source.hpp"

namespace comma::interpreter {

class Value;

/// A keyword argument as written: NAME=value, with both places.
struct Argument {
  std::string name;
  Span name_span;
  std::shared_ptr<const Value> value;
  Span value_span;
};

/// _F(A=1, B=2): the arguments in the order of the file. Two arguments never share a name.
struct Factor {
  std::vector<Argument> arguments;
  Span span;
};

/// A value. Sequences and mappings have Python's reference meaning (a list assigned twice is one list).
class Value {
 public:
  Value();  ///< None
  Value(bool value);
  Value(std::int64_t value);
  Value(int value) : Value(static_cast<std::int64_t>(value)) {}
  Value(double value);
  Value(std::complex<double> value);
  Value(std::string text);
  Value(const char* text) : Value(std::string(text)) {}
  Value(ConceptPtr handle);
  Value(std::shared_ptr<const Factor> factor);
  static Value tuple(std::vector<Value> items);
  static Value list(std::vector<Value> items);
  /// The value of something that was already reported as wrong: every operation on it gives unknown again, every check
  /// passes it, so that one mistake makes one error.
  static Value unknown();

  bool is_unknown() const;
  bool is_none() const;
  bool is_bool() const;
  bool is_integer() const;   ///< an int that fits 64 bits; a bool is not one
  bool is_real() const;      ///< a float
  bool is_number() const;    ///< int or float, not bool
  bool is_complex() const;
  bool is_text() const;
  bool is_tuple() const;
  bool is_list() const;
  bool is_sequence() const;  ///< tuple or list
  bool is_dict() const;
  bool is_factor() const;
  bool is_concept() const;
  bool is_callable() const;

  /// Each throws std::logic_error on a value of another type.
  bool as_bool() const;
  std::int64_t as_integer() const;
  double as_real() const;  ///< also of an int
  std::complex<double> as_complex() const;  ///< also of an int or a float
  const std::string& as_text() const;
  std::span<const Value> items() const;  ///< of a tuple or a list
  const Factor& as_factor() const;
  const ConceptPtr& as_concept() const;

  /// Python's name of the type: "int", "float", "str", "tuple" ... ; "_F" and the concept's own type name beside them.
  std::string type_name() const;
  /// Python's repr(); a concept shows its name.
  std::string repr() const;
};

}  // namespace comma::interpreter
