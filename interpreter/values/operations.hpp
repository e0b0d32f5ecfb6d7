// What operators do to values: arithmetic, comparison, membership, subscripts. Errors are raised as Python raises them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/evaluation/meter.hpp"
#include "interpreter/syntax/ast.hpp"
#include "interpreter/values/big_integer.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {

Value binary_operation(Operator op, const Value& a, const Value& b, Meter& meter);
Value unary_operation(Operator op, const Value& a);  ///< of an array, an array of its own
/// a += b and its like: a list grows in place, an array changes in place, everything else is as the plain operator.
Value augmented_operation(Operator op, const Value& a, const Value& b, Meter& meter);
Value compare(Operator op, const Value& a, const Value& b);

/// Whether the value is not known, or one in the items of a list or tuple, or in theirs.
bool holds_unknown(const Value& value, int depth = 0);

bool truth(const Value& value);
bool less_than(const Value& a, const Value& b);
bool contains(const Value& container, const Value& item);
bool identical(const Value& a, const Value& b);

/// len(); nothing when the value has no length.
std::optional<std::int64_t> length_of(const Value& value);

Value subscript(const Value& object, const Value& index, Meter& meter);
void store_subscript(const Value& object, const Value& index, const Value& value, Meter& meter);
void delete_subscript(const Value& object, const Value& index);

/// The indices a slice selects of a sequence of this length.
struct SliceRange {
  std::int64_t start, step, count;
};
SliceRange resolve_slice(const SliceObject& slice, std::int64_t length);

/// An int of any size (a bool counts as 0 or 1), or nothing.
std::optional<BigInteger> integer_of(const Value& value);
/// An int that fits 64 bits; raises TypeError ("... cannot be interpreted as an integer") or OverflowError.
std::int64_t index_of(const Value& value);
/// A real number of an int, a bool or a float; raises TypeError, and OverflowError for an int beyond float's range.
double real_of(const Value& value);
bool is_numeric(const Value& value);  ///< bool, int, float, complex
/// Whether it is a bool or an int of any size.
inline bool is_integral(const Value& value) { return value.is_integer() || value.is_bool() || value.is_big_integer(); }
/// An int that fits 64 bits, or a bool as 0 or 1; else nothing.
inline std::optional<std::int64_t> small_integer(const Value& value) {
  if (value.is_integer()) return value.as_integer();
  if (value.is_bool()) return value.as_bool() ? 1 : 0;
  return std::nullopt;
}

std::vector<Value> list_of(const Value& iterable, Meter& meter);

Value floor_divide(const Value& a, const Value& b);
Value modulo(const Value& a, const Value& b);
Value power(const Value& a, const Value& b, Meter& meter);

}  // namespace comma::interpreter
