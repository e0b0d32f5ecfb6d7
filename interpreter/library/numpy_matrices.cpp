// numpy's products of vectors and matrices.
#include <array>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

Value dot(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("dot", arguments, 2, 2);
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  const bool scales = a.shape.empty() || b.shape.empty();
  return make_value(scales ? combine(Operator::multiply, a, b, evaluator.meter())
                           : matrix_product(a, b, evaluator.meter()));
}

Value matmul(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("matmul", arguments, 2, 2);
  return array_operation(Operator::matrix_multiply, arguments[0], arguments[1], evaluator.meter());
}

Value vdot(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("vdot", arguments, 2, 2);
  const Numbers a = flattened(argument(evaluator, arguments[0])), b = flattened(argument(evaluator, arguments[1]));
  return make_value(matrix_product(a, b, evaluator.meter()));
}

/// Over the last axes of both.
Value inner(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("inner", arguments, 2, 2);
  const Value b = make_value(argument(evaluator, arguments[1]));
  const auto* matrix = b.as_object<ArrayObject>();
  if (matrix == nullptr || matrix->shape.size() == 1) return dot(evaluator, arguments);
  const Numbers a = argument(evaluator, arguments[0]);
  if (a.shape.empty()) return dot(evaluator, arguments);
  const Value turned = transposed(*matrix);
  return make_value(matrix_product(a, argument(evaluator, turned), evaluator.meter()));
}

Value outer(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("outer", arguments, 2, 2);
  Numbers a = argument(evaluator, arguments[0]);
  const Numbers b = flattened(argument(evaluator, arguments[1]));
  a.shape = {a.data.size(), 1};
  return make_value(combine(Operator::multiply, a, b, evaluator.meter()));
}

Value cross(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("cross", arguments, 2, 2);
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  if (a.shape != Shape{3} || b.shape != Shape{3})
    raise(ErrorKind::value, "a cross product needs two vectors of three components");
  const auto& x = a.data;
  const auto& y = b.data;
  const std::vector<double> product = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  return make_value(converted({product, {3}, NumberType::real}, std::max(a.type, b.type)));
}

constexpr std::array matrix_table = {
    FunctionRow{"dot", dot},     FunctionRow{"matmul", matmul}, FunctionRow{"vdot", vdot},
    FunctionRow{"inner", inner}, FunctionRow{"outer", outer},   FunctionRow{"cross", cross},
};

constexpr std::array matrix_method_table = {MethodRow{"dot", as_method<dot>}};

}  // namespace

std::span<const FunctionRow> matrix_functions() { return matrix_table; }
std::span<const MethodRow> matrix_methods() { return matrix_method_table; }

}  // namespace comma::interpreter::numpy
