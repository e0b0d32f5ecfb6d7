// The methods of numbers.
#include <array>
#include <cmath>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

Value is_integer(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("is_integer", arguments, 0, 0);
  if (!self.is_real()) raise(ErrorKind::attribute, "'" + self.type_name() + "' object has no attribute 'is_integer'");
  return std::isfinite(self.as_real()) && self.as_real() == std::trunc(self.as_real());
}

Value conjugate(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("conjugate", arguments, 0, 0);
  return self.is_complex() ? Value(std::conj(self.as_complex())) : unary_operation(Operator::plus, self);
}

Value bit_length(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("bit_length", arguments, 0, 0);
  const auto integer = integer_of(self);
  if (!integer) raise(ErrorKind::attribute, "'" + self.type_name() + "' object has no attribute 'bit_length'");
  return static_cast<std::int64_t>(integer->bit_length());
}

constexpr std::array number_table = {MethodRow{"is_integer", is_integer}, MethodRow{"conjugate", conjugate},
                                     MethodRow{"bit_length", bit_length}};

}  // namespace

std::span<const MethodRow> number_methods() { return number_table; }

}  // namespace comma::interpreter
