// The few functions of numpy that command files use.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "interpreter/array.hpp"
#include "interpreter/builtins.hpp"
#include "interpreter/operations.hpp"

namespace comma::interpreter {

namespace {

Numbers argument(Evaluator& evaluator, const Value& value) { return numbers_of(value, evaluator.meter()); }

Numbers array_argument(Evaluator& evaluator, const Value& value) {
  Numbers numbers = argument(evaluator, value);
  if (numbers.shape.empty()) raise(ErrorKind::not_implemented, "arrays of no dimension are not there", "use the number itself");
  return numbers;
}

std::optional<NumberType> type_named(const Value& word) {
  if (word.is_none()) return std::nullopt;
  const auto* type = word.as_object<TypeObject>();
  if (type != nullptr && type->name == "float") return NumberType::real;
  if (type != nullptr && type->name == "int") return NumberType::integer;
  if (type != nullptr && type->name == "bool") return NumberType::boolean;
  raise(ErrorKind::not_implemented, "arrays are of int, float or bool");
}

std::optional<NumberType> type_argument(const CallArguments& arguments, std::size_t position) {
  const Value* word = arguments.size() > position ? &arguments[position] : arguments.find("dtype");
  return word == nullptr ? std::nullopt : type_named(*word);
}

Value array(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("array", arguments, 1, 2, {"dtype"});
  Numbers numbers = array_argument(evaluator, arguments[0]);
  const auto type = type_argument(arguments, 1);
  return make_value(type ? converted(std::move(numbers), *type) : std::move(numbers));
}

/// The array itself where it is one of that type.
Value asarray(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("asarray", arguments, 1, 2, {"dtype"});
  const auto* given = arguments[0].as_object<ArrayObject>();
  if (given != nullptr && type_argument(arguments, 1).value_or(given->type) == given->type) return arguments[0];
  return array(evaluator, arguments);
}

Value filled(Evaluator& evaluator, const CallArguments& arguments, std::string_view name, double value) {
  expect_arguments(name, arguments, 1, 2, {"dtype"});
  std::vector<std::size_t> shape;
  const std::vector<Value> lengths =
      arguments[0].is_sequence() ? list_of(arguments[0], evaluator.meter()) : std::vector<Value>{arguments[0]};
  std::uint64_t size = 1;
  for (const Value& length : lengths) {
    const std::int64_t n = index_of(length);
    if (n < 0) raise(ErrorKind::value, "negative dimensions are not allowed");
    evaluator.meter().allocate(static_cast<std::uint64_t>(n) > (1ULL << 40) ? 1ULL << 40
                                                                            : static_cast<std::uint64_t>(n) * 8);
    shape.push_back(static_cast<std::size_t>(n));
    size *= static_cast<std::uint64_t>(n);
    evaluator.meter().allocate(size > (1ULL << 40) ? 1ULL << 40 : size * 8);
  }
  if (shape.empty() || shape.size() > 2) raise(ErrorKind::not_implemented, "arrays have one or two dimensions");
  return make_value({std::vector<double>(size, value), std::move(shape), type_argument(arguments, 1).value_or(NumberType::real)});
}

Value zeros(Evaluator& evaluator, const CallArguments& arguments) {
  return filled(evaluator, arguments, "zeros", 0.0);
}
Value ones(Evaluator& evaluator, const CallArguments& arguments) {
  return filled(evaluator, arguments, "ones", 1.0);
}

Value linspace(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("linspace", arguments, 2, 3, {"num"});
  const Value* count = arguments.size() > 2 ? &arguments[2] : arguments.find("num");
  const std::int64_t n = count != nullptr ? index_of(*count) : 50;
  if (n < 0) raise(ErrorKind::value, fmt::format("Number of samples, {}, must be non-negative.", n));
  evaluator.meter().allocate_items(static_cast<std::uint64_t>(n));
  const double start = real_of(arguments[0]), stop = real_of(arguments[1]);
  std::vector<double> data(static_cast<std::size_t>(n));
  const double step = n > 1 ? (stop - start) / static_cast<double>(n - 1) : 0.0;
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = start + static_cast<double>(i) * step;
  if (n > 1) data.back() = stop;
  return make_value({std::move(data), {static_cast<std::size_t>(n)}, NumberType::real});
}

Value arange(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("arange", arguments, 1, 3);
  const double start = arguments.size() > 1 ? real_of(arguments[0]) : 0.0;
  const double stop = real_of(arguments[arguments.size() > 1 ? 1 : 0]);
  const double step = arguments.size() > 2 ? real_of(arguments[2]) : 1.0;
  if (step == 0.0) raise(ErrorKind::zero_division, "division by zero");
  const double count = std::max(0.0, std::ceil((stop - start) / step));
  evaluator.meter().allocate(count > 1e15 ? 1ULL << 50 : static_cast<std::uint64_t>(count) * 24);
  std::vector<double> data(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = start + static_cast<double>(i) * step;
  const bool integers = std::none_of(arguments.positional.begin(), arguments.positional.end(),
                                     [](const Value& v) { return v.is_real(); });
  const std::size_t size = data.size();
  return make_value({std::move(data), {size}, integers ? NumberType::integer : NumberType::real});
}

template <double (*Function)(double)>
Value elementwise(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 1);
  Numbers numbers = argument(evaluator, arguments[0]);
  for (double& number : numbers.data) number = Function(number);
  numbers.type = NumberType::real;
  return make_value(std::move(numbers));
}

Value array_sum(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("sum", arguments, 1, 1);
  const Numbers source = argument(evaluator, arguments[0]);
  return array_number(std::accumulate(source.data.begin(), source.data.end(), 0.0), std::max(source.type, NumberType::integer));
}

Value mean(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("mean", arguments, 1, 1);
  const Numbers source = argument(evaluator, arguments[0]);
  return std::accumulate(source.data.begin(), source.data.end(), 0.0) / static_cast<double>(source.data.size());
}

Value array_extreme(Evaluator& evaluator, const CallArguments& arguments, bool largest, bool place) {
  expect_arguments("max", arguments, 1, 1);
  const Numbers source = argument(evaluator, arguments[0]);
  if (source.data.empty()) raise(ErrorKind::value, "zero-size array to reduction operation which has no identity");
  const auto found = largest ? std::max_element(source.data.begin(), source.data.end())
                             : std::min_element(source.data.begin(), source.data.end());
  if (place) return static_cast<std::int64_t>(found - source.data.begin());
  return array_number(*found, source.type);
}

Value array_max(Evaluator& evaluator, const CallArguments& arguments) {
  return array_extreme(evaluator, arguments, true, false);
}
Value array_min(Evaluator& evaluator, const CallArguments& arguments) {
  return array_extreme(evaluator, arguments, false, false);
}
Value argmax(Evaluator& evaluator, const CallArguments& arguments) {
  return array_extreme(evaluator, arguments, true, true);
}
Value argmin(Evaluator& evaluator, const CallArguments& arguments) {
  return array_extreme(evaluator, arguments, false, true);
}

Value dot(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("dot", arguments, 2, 2);
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  const bool scales = a.shape.empty() || b.shape.empty();
  return make_value(scales ? combine(Operator::multiply, a, b, evaluator.meter()) : matrix_product(a, b, evaluator.meter()));
}

Value cross(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("cross", arguments, 2, 2);
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  if (a.data.size() != 3 || b.data.size() != 3)
    raise(ErrorKind::value, "a cross product needs two vectors of three components");
  const auto& x = a.data;
  const auto& y = b.data;
  return make_value({{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]}, {3},
                     std::max(a.type, b.type)});
}

Value norm(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("norm", arguments, 1, 1);
  const Numbers source = argument(evaluator, arguments[0]);
  return std::sqrt(std::inner_product(source.data.begin(), source.data.end(), source.data.begin(), 0.0));
}

Value absolute(Evaluator& evaluator, const CallArguments& arguments) {
  return elementwise<std::fabs>(evaluator, arguments);
}

// Methods

template <Builtin Function>
Value as_method(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  CallArguments all = arguments;
  all.positional.insert(all.positional.begin(), self);
  return Function(evaluator, all);
}

Value tolist(Evaluator&, const Value& self, const CallArguments&) {
  return self.as_object<ArrayObject>()->to_list();
}

Value copy(Evaluator& evaluator, const Value& self, const CallArguments&) {
  return make_value(argument(evaluator, self));
}

Value flatten(Evaluator& evaluator, const Value& self, const CallArguments&) {
  Numbers numbers = argument(evaluator, self);
  numbers.shape = {numbers.data.size()};
  return make_value(std::move(numbers));
}

Value ravel(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  const auto& array = *self.as_object<ArrayObject>();
  if (!array.is_contiguous()) return flatten(evaluator, self, arguments);
  return make_window(array, array.offset, {array.size()}, {1});
}

Value transpose(Evaluator&, const Value& self, const CallArguments&) { return transposed(*self.as_object<ArrayObject>()); }

Value transpose_of(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("transpose", arguments, 1, 1);
  const Value array = asarray(evaluator, arguments);
  return transposed(*array.as_object<ArrayObject>());
}

/// Arrays one after the other, or their rows.
Value concatenate(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("concatenate", arguments, 1, 1);
  if (!arguments[0].is_sequence() || arguments[0].items().empty()) raise(ErrorKind::value, "need at least one array to concatenate");
  std::vector<double> data;
  std::vector<std::size_t> shape;
  NumberType type = NumberType::boolean;
  for (const Value& part : arguments[0].items()) {
    const Numbers source = array_argument(evaluator, part);
    if (shape.empty()) {
      shape = source.shape;
      shape.front() = 0;
    }
    if (source.shape.size() != shape.size() || source.shape.back() != (shape.size() == 2 ? shape.back() : source.shape.back()))
      raise(ErrorKind::value, "all the input array dimensions except for the concatenation axis must match exactly");
    shape.front() += source.shape.front();
    evaluator.meter().allocate(source.data.size() * sizeof(double));
    data.insert(data.end(), source.data.begin(), source.data.end());
    type = std::max(type, source.type);
  }
  return make_value({std::move(data), std::move(shape), type});
}

constexpr std::array array_function_table = {
    FunctionRow{"array", array},
    FunctionRow{"asarray", asarray},
    FunctionRow{"zeros", zeros},
    FunctionRow{"ones", ones},
    FunctionRow{"linspace", linspace},
    FunctionRow{"arange", arange},
    FunctionRow{"sum", array_sum},
    FunctionRow{"mean", mean},
    FunctionRow{"max", array_max},
    FunctionRow{"min", array_min},
    FunctionRow{"amax", array_max},
    FunctionRow{"amin", array_min},
    FunctionRow{"argmax", argmax},
    FunctionRow{"argmin", argmin},
    FunctionRow{"transpose", transpose_of},
    FunctionRow{"concatenate", concatenate},
    FunctionRow{"dot", dot},
    FunctionRow{"cross", cross},
    FunctionRow{"norm", norm},
    FunctionRow{"abs", absolute},
    FunctionRow{"fabs", absolute},
    FunctionRow{"absolute", absolute},
    FunctionRow{"sqrt", elementwise<std::sqrt>},
    FunctionRow{"sin", elementwise<std::sin>},
    FunctionRow{"cos", elementwise<std::cos>},
    FunctionRow{"tan", elementwise<std::tan>},
    FunctionRow{"exp", elementwise<std::exp>},
    FunctionRow{"log", elementwise<std::log>},
    FunctionRow{"log10", elementwise<std::log10>},
    FunctionRow{"arcsin", elementwise<std::asin>},
    FunctionRow{"arccos", elementwise<std::acos>},
    FunctionRow{"arctan", elementwise<std::atan>},
    FunctionRow{"sinh", elementwise<std::sinh>},
    FunctionRow{"cosh", elementwise<std::cosh>},
    FunctionRow{"tanh", elementwise<std::tanh>},
    FunctionRow{"floor", elementwise<std::floor>},
    FunctionRow{"ceil", elementwise<std::ceil>},
};

constexpr std::array array_method_table = {
    MethodRow{"tolist", tolist},
    MethodRow{"copy", copy},
    MethodRow{"flatten", flatten},
    MethodRow{"ravel", ravel},
    MethodRow{"transpose", transpose},
    MethodRow{"sum", as_method<array_sum>},
    MethodRow{"mean", as_method<mean>},
    MethodRow{"max", as_method<array_max>},
    MethodRow{"min", as_method<array_min>},
    MethodRow{"argmax", as_method<argmax>},
    MethodRow{"argmin", as_method<argmin>},
    MethodRow{"dot", as_method<dot>},
};

}  // namespace

std::span<const FunctionRow> numpy_functions() {
  return array_function_table;
}
std::span<const MethodRow> array_methods() {
  return array_method_table;
}

}  // namespace comma::interpreter
