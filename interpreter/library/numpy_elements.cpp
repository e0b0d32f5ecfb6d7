// numpy's functions of one element, or of two that stand in the same place.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

template <double (*Function)(double)>
Value to_real(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 1);
  Numbers numbers = argument(evaluator, arguments[0]);
  for (double& number : numbers.data) number = Function(number);
  numbers.type = NumberType::real;
  return make_value(std::move(numbers));
}

/// Integers stay integers.
template <double (*Function)(double)>
Value keeping_type(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 1);
  Numbers numbers = argument(evaluator, arguments[0]);
  for (double& number : numbers.data) number = converted(Function(number), numbers.type);
  return make_value(std::move(numbers));
}

template <bool (*Function)(double)>
Value to_boolean(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 1);
  Numbers numbers = argument(evaluator, arguments[0]);
  for (double& number : numbers.data) number = Function(number) ? 1.0 : 0.0;
  numbers.type = NumberType::boolean;
  return make_value(std::move(numbers));
}

double magnitude(double x) { return std::fabs(x); }
double sign_of(double x) { return std::isnan(x) ? x : x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }
double squared(double x) { return x * x; }
double to_radians(double x) { return x * (std::numbers::pi / 180.0); }
double to_degrees(double x) { return x * (180.0 / std::numbers::pi); }
bool is_nan(double x) { return std::isnan(x); }
bool is_finite(double x) { return std::isfinite(x); }
bool is_infinite(double x) { return std::isinf(x); }
bool is_zero(double x) { return x == 0.0; }

Numbers pairwise(Evaluator& evaluator, const Numbers& a, const Numbers& b, NumberType type,
                 double (*function)(double, double)) {
  Numbers result{{}, broadcast_shape(a.shape, b.shape), type};
  evaluator.meter().allocate(size_of(result.shape) * sizeof(double));
  result.data = spread(a, result.shape);
  const std::vector<double> right = spread(b, result.shape);
  for (std::size_t i = 0; i < right.size(); ++i) result.data[i] = function(result.data[i], right[i]);
  return result;
}

template <double (*Function)(double, double)>
Value real_of_two(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 2, 2);
  return make_value(pairwise(evaluator, argument(evaluator, arguments[0]), argument(evaluator, arguments[1]),
                             NumberType::real, Function));
}

double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }
double smaller(double a, double b) { return std::isnan(a) || a <= b ? a : b; }
double angle(double y, double x) { return std::atan2(y, x); }
double hypotenuse(double a, double b) { return std::hypot(a, b); }
double both(double a, double b) { return a != 0.0 && b != 0.0 ? 1.0 : 0.0; }
double either(double a, double b) { return a != 0.0 || b != 0.0 ? 1.0 : 0.0; }

/// Both kinds of number in one: what is chosen among is brought to the common type.
template <double (*Function)(double, double)>
Value choice_of_two(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 2, 2);
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  return make_value(pairwise(evaluator, a, b, std::max(a.type, b.type), Function));
}

template <double (*Function)(double, double)>
Value truth_of_two(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 2, 2);
  return make_value(pairwise(evaluator, argument(evaluator, arguments[0]), argument(evaluator, arguments[1]),
                             NumberType::boolean, Function));
}

template <Operator Op>
Value operator_function(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 2, 2);
  return array_operation(Op, arguments[0], arguments[1], evaluator.meter());
}

template <Operator Op>
Value sign_function(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 1);
  return make_value(negated(Op, argument(evaluator, arguments[0])));
}

Value clipped(Evaluator& evaluator, const CallArguments& arguments, std::string_view lowest, std::string_view highest) {
  expect_arguments("clip", arguments, 1, 3, {lowest, highest});
  Numbers numbers = argument(evaluator, arguments[0]);
  const auto bounded = [&](const Value* bound, double (*function)(double, double)) {
    if (bound == nullptr || bound->is_none()) return;
    const Numbers limit = argument(evaluator, *bound);
    numbers = pairwise(evaluator, numbers, limit, std::max(numbers.type, limit.type), function);
  };
  bounded(option(arguments, 1, lowest), larger);
  bounded(option(arguments, 2, highest), smaller);
  return make_value(std::move(numbers));
}

Value clip(Evaluator& evaluator, const CallArguments& arguments) {
  return clipped(evaluator, arguments, "a_min", "a_max");
}
Value clip_own(Evaluator& evaluator, const CallArguments& arguments) {
  return clipped(evaluator, arguments, "min", "max");
}

/// To an even neighbour from the middle, as numpy does: scaled, rounded, scaled back.
Value round_numbers(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("round", arguments, 1, 2, {"decimals"});
  Numbers numbers = argument(evaluator, arguments[0]);
  const Value* digits = option(arguments, 1, "decimals");
  const std::int64_t decimals = digits != nullptr ? index_of(*digits) : 0;
  if (numbers.type != NumberType::real && decimals >= 0) return make_value(std::move(numbers));
  const double scale = std::pow(10.0, static_cast<double>(std::abs(decimals)));
  for (double& number : numbers.data) {
    number = decimals >= 0 ? std::nearbyint(number * scale) / scale : std::nearbyint(number / scale) * scale;
  }
  return make_value(std::move(numbers));
}

/// |a - b| <= atol + rtol |b|; infinities are close to themselves.
Numbers closeness(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("isclose", arguments, 2, 4, {"rtol", "atol"});
  const Value* relative = option(arguments, 2, "rtol");
  const Value* absolute = option(arguments, 3, "atol");
  const double rtol = relative != nullptr ? real_of(*relative) : 1e-5,
               atol = absolute != nullptr ? real_of(*absolute) : 1e-8;
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  Numbers close{{}, broadcast_shape(a.shape, b.shape), NumberType::boolean};
  const std::vector<double> x = spread(a, close.shape), y = spread(b, close.shape);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool finite = std::isfinite(x[i]) && std::isfinite(y[i]);
    close.data.push_back((finite ? std::abs(x[i] - y[i]) <= atol + rtol * std::abs(y[i]) : x[i] == y[i]) ? 1.0 : 0.0);
  }
  return close;
}

Value isclose(Evaluator& evaluator, const CallArguments& arguments) {
  return make_value(closeness(evaluator, arguments));
}

Value allclose(Evaluator& evaluator, const CallArguments& arguments) {
  const Numbers close = closeness(evaluator, arguments);
  return std::ranges::find(close.data, 0.0) == close.data.end();
}

Value array_equal(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("array_equal", arguments, 2, 2);
  const Numbers a = argument(evaluator, arguments[0]), b = argument(evaluator, arguments[1]);
  return a.shape == b.shape && a.data == b.data;
}

/// The indices along each axis of what is not zero.
Value places_of(const Numbers& numbers) {
  std::vector<Value> axes;
  std::size_t stride = numbers.data.size();
  for (const std::size_t length : numbers.shape) {
    Numbers places{{}, {}, NumberType::integer};
    stride = length == 0 ? 0 : stride / length;
    for (std::size_t i = 0; i < numbers.data.size(); ++i)
      if (numbers.data[i] != 0.0) places.data.push_back(static_cast<double>(i / stride % length));
    places.shape = {places.data.size()};
    axes.push_back(make_value(std::move(places)));
  }
  return Value::tuple(std::move(axes));
}

Value nonzero(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("nonzero", arguments, 1, 1);
  return places_of(array_argument(evaluator, arguments[0]));
}

Value where(Evaluator& evaluator, const CallArguments& arguments) {
  if (arguments.size() == 1) return nonzero(evaluator, arguments);
  expect_arguments("where", arguments, 3, 3);
  const Numbers condition = argument(evaluator, arguments[0]);
  const Numbers a = argument(evaluator, arguments[1]), b = argument(evaluator, arguments[2]);
  Numbers result{{}, broadcast_shape(condition.shape, broadcast_shape(a.shape, b.shape)), std::max(a.type, b.type)};
  evaluator.meter().allocate(size_of(result.shape) * sizeof(double));
  const std::vector<double> chosen = spread(condition, result.shape), other = spread(b, result.shape);
  result.data = spread(a, result.shape);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i] == 0.0) result.data[i] = other[i];
  return make_value(std::move(result));
}

constexpr std::array element_table = {
    FunctionRow{"abs", keeping_type<magnitude>},
    FunctionRow{"absolute", keeping_type<magnitude>},
    FunctionRow{"fabs", to_real<magnitude>},
    FunctionRow{"sign", keeping_type<sign_of>},
    FunctionRow{"square", keeping_type<squared>},
    FunctionRow{"sqrt", to_real<std::sqrt>},
    FunctionRow{"sin", to_real<std::sin>},
    FunctionRow{"cos", to_real<std::cos>},
    FunctionRow{"tan", to_real<std::tan>},
    FunctionRow{"exp", to_real<std::exp>},
    FunctionRow{"log", to_real<std::log>},
    FunctionRow{"log10", to_real<std::log10>},
    FunctionRow{"arcsin", to_real<std::asin>},
    FunctionRow{"arccos", to_real<std::acos>},
    FunctionRow{"arctan", to_real<std::atan>},
    FunctionRow{"sinh", to_real<std::sinh>},
    FunctionRow{"cosh", to_real<std::cosh>},
    FunctionRow{"tanh", to_real<std::tanh>},
    FunctionRow{"floor", to_real<std::floor>},
    FunctionRow{"ceil", to_real<std::ceil>},
    FunctionRow{"deg2rad", to_real<to_radians>},
    FunctionRow{"radians", to_real<to_radians>},
    FunctionRow{"rad2deg", to_real<to_degrees>},
    FunctionRow{"degrees", to_real<to_degrees>},
    FunctionRow{"isnan", to_boolean<is_nan>},
    FunctionRow{"isfinite", to_boolean<is_finite>},
    FunctionRow{"isinf", to_boolean<is_infinite>},
    FunctionRow{"logical_not", to_boolean<is_zero>},
    FunctionRow{"logical_and", truth_of_two<both>},
    FunctionRow{"logical_or", truth_of_two<either>},
    FunctionRow{"arctan2", real_of_two<angle>},
    FunctionRow{"hypot", real_of_two<hypotenuse>},
    FunctionRow{"maximum", choice_of_two<larger>},
    FunctionRow{"minimum", choice_of_two<smaller>},
    FunctionRow{"negative", sign_function<Operator::minus>},
    FunctionRow{"add", operator_function<Operator::add>},
    FunctionRow{"subtract", operator_function<Operator::subtract>},
    FunctionRow{"multiply", operator_function<Operator::multiply>},
    FunctionRow{"divide", operator_function<Operator::divide>},
    FunctionRow{"power", operator_function<Operator::power>},
    FunctionRow{"mod", operator_function<Operator::modulo>},
    FunctionRow{"clip", clip},
    FunctionRow{"round", round_numbers},
    FunctionRow{"around", round_numbers},
    FunctionRow{"isclose", isclose},
    FunctionRow{"allclose", allclose},
    FunctionRow{"array_equal", array_equal},
    FunctionRow{"nonzero", nonzero},
    FunctionRow{"where", where},
};

constexpr std::array element_method_table = {
    MethodRow{"round", as_method<round_numbers>},
    MethodRow{"clip", as_method<clip_own>},
    MethodRow{"nonzero", as_method<nonzero>},
};

}  // namespace

std::span<const FunctionRow> element_functions() { return element_table; }
std::span<const MethodRow> element_methods() { return element_method_table; }

}  // namespace comma::interpreter::numpy
