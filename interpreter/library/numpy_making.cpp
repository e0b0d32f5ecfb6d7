// numpy's functions that make arrays: array, zeros, linspace, arange ...
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/dtype.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

Value array(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("array", arguments, 1, 2, {"dtype"});
  if (holds_unknown(arguments[0]))
    return Value::unknown();  // what was reported already must not be reported again as no number
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

Shape shape_argument(Evaluator& evaluator, const Value& value) {
  Shape shape;
  const bool several = value.is_sequence() || value.as_object<ArrayObject>() != nullptr;
  const std::vector<Value> lengths = several ? list_of(value, evaluator.meter()) : std::vector<Value>{value};
  constexpr std::uint64_t too_many = 1ULL << 40;
  std::uint64_t size = 1;
  for (const Value& length : lengths) {
    const std::int64_t n = index_of(length);
    if (n < 0) raise(ErrorKind::value, "negative dimensions are not allowed");
    shape.push_back(static_cast<std::size_t>(n));
    size =
        static_cast<std::uint64_t>(n) > too_many ? too_many : std::min(size * static_cast<std::uint64_t>(n), too_many);
    evaluator.meter().allocate(std::max<std::uint64_t>(size, std::min(static_cast<std::uint64_t>(n), too_many)) * 8);
  }
  if (shape.empty() || shape.size() > 2)
    raise(ErrorKind::not_implemented, fmt::format("arrays have one or two dimensions here, not {}", shape.size()));
  return shape;
}

Value filled(Shape shape, double value, NumberType type) {
  const std::size_t size = size_of(shape);
  return make_value({std::vector<double>(size, converted(value, type)), std::move(shape), type});
}

template <int Value_>
Value constant(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 2, {"dtype"});
  return filled(shape_argument(evaluator, arguments[0]), Value_,
                type_argument(arguments, 1).value_or(NumberType::real));
}

template <int Value_>
Value constant_like(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 2, {"dtype"});
  const Numbers like = array_argument(evaluator, arguments[0]);
  return filled(like.shape, Value_, type_argument(arguments, 1).value_or(like.type));
}

/// The number that fills an array, and its type when none is asked for.
Numbers filling(Evaluator& evaluator, const CallArguments& arguments) {
  const Value* value = option(arguments, 1, "fill_value");
  if (value == nullptr) raise(ErrorKind::type, "fill_value is missing");
  Numbers number = argument(evaluator, *value);
  if (number.data.size() != 1) raise(ErrorKind::not_implemented, "an array is filled with one number here");
  return number;
}

Value full(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("full", arguments, 1, 3, {"fill_value", "dtype"});
  const Numbers number = filling(evaluator, arguments);
  return filled(shape_argument(evaluator, arguments[0]), number.data[0],
                type_argument(arguments, 2).value_or(number.type));
}

Value full_like(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("full_like", arguments, 1, 3, {"fill_value", "dtype"});
  const Numbers like = array_argument(evaluator, arguments[0]);
  return filled(like.shape, filling(evaluator, arguments).data[0], type_argument(arguments, 2).value_or(like.type));
}

Value eye(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("eye", arguments, 1, 3, {"M", "k", "dtype"});
  const Value* width = option(arguments, 1, "M");
  const bool square = width == nullptr || width->is_none();
  const Shape shape = shape_argument(evaluator, Value::tuple({arguments[0], square ? arguments[0] : *width}));
  const Value* diagonal = option(arguments, 2, "k");
  const std::int64_t k = diagonal != nullptr ? index_of(*diagonal) : 0;
  Numbers numbers{std::vector<double>(size_of(shape), 0.0), shape,
                  type_argument(arguments, 3).value_or(NumberType::real)};
  for (std::size_t i = 0; i < shape[0]; ++i) {
    const std::int64_t j = static_cast<std::int64_t>(i) + k;
    if (j >= 0 && j < static_cast<std::int64_t>(shape[1]))
      numbers.data[i * shape[1] + static_cast<std::size_t>(j)] = 1.0;
  }
  return make_value(std::move(numbers));
}

Value identity(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("identity", arguments, 1, 1, {"dtype"});
  return eye(evaluator, arguments);
}

/// `num` numbers from start to stop, which is left out without endpoint.
std::vector<double> spaced(Evaluator& evaluator, const CallArguments& arguments) {
  const Value* count = option(arguments, 2, "num");
  const Value* closed = option(arguments, 3, "endpoint");
  const std::int64_t n = count != nullptr ? index_of(*count) : 50;
  if (n < 0) raise(ErrorKind::value, fmt::format("Number of samples, {}, must be non-negative.", n));
  evaluator.meter().allocate_items(static_cast<std::uint64_t>(n));
  const double start = real_of(arguments[0]), stop = real_of(arguments[1]);
  const bool ends = closed == nullptr || truth(*closed);
  const std::int64_t steps = ends ? n - 1 : n;
  const double step = steps > 0 ? (stop - start) / static_cast<double>(steps) : 0.0;
  std::vector<double> data(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = start + static_cast<double>(i) * step;
  if (ends && n > 1) data.back() = stop;
  return data;
}

Value linspace(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("linspace", arguments, 2, 4, {"num", "endpoint"});
  std::vector<double> data = spaced(evaluator, arguments);
  const std::size_t size = data.size();
  return make_value({std::move(data), {size}, NumberType::real});
}

Value logspace(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("logspace", arguments, 2, 5, {"num", "endpoint", "base"});
  const Value* given = option(arguments, 4, "base");
  const double base = given != nullptr ? real_of(*given) : 10.0;
  std::vector<double> data = spaced(evaluator, arguments);
  for (double& number : data) number = std::pow(base, number);
  const std::size_t size = data.size();
  return make_value({std::move(data), {size}, NumberType::real});
}

Value arange(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("arange", arguments, 1, 4, {"dtype"});
  const std::size_t given = std::min<std::size_t>(arguments.size(), 3);
  const double start = given > 1 ? real_of(arguments[0]) : 0.0, stop = real_of(arguments[given > 1 ? 1 : 0]);
  const double step = given > 2 ? real_of(arguments[2]) : 1.0;
  if (step == 0.0) raise(ErrorKind::zero_division, "division by zero");
  const double count = std::max(0.0, std::ceil((stop - start) / step));
  evaluator.meter().allocate(count < 1e15 ? static_cast<std::uint64_t>(count) * 24 : 1ULL << 50);
  // numpy adds the difference of the first two numbers, which rounding may set apart from the step.
  const double difference = (start + step) - start;
  std::vector<double> data(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < data.size(); ++i)
    data[i] = i == 1 ? start + step : start + static_cast<double>(i) * difference;
  const bool real =
      std::any_of(arguments.positional.begin(), arguments.positional.begin() + static_cast<std::ptrdiff_t>(given),
                  [](const Value& v) { return v.is_real(); });
  const std::size_t size = data.size();
  Numbers numbers{std::move(data), {size}, real ? NumberType::real : NumberType::integer};
  const auto type = type_argument(arguments, 3);
  return make_value(type ? converted(std::move(numbers), *type) : std::move(numbers));
}

Value copy(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("copy", arguments, 1, 1);
  return make_value(array_argument(evaluator, arguments[0]));
}

// Methods

Value tolist(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("tolist", arguments, 0, 0);
  const auto& array = *self.as_object<ArrayObject>();
  evaluator.meter().allocate_items(array.size());
  return array.to_list();
}

Value astype(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("astype", arguments, 1, 1);
  const auto type = number_type_of(arguments[0]).value_or(NumberType::real);
  return make_value(converted(argument(evaluator, self), type));
}

Value fill(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("fill", arguments, 1, 1);
  auto& array = *self.as_object<ArrayObject>();
  const double value = converted(real_of(arguments[0]), array.type);
  evaluator.meter().allocate(array.size() * sizeof(double));
  array.write(std::vector<double>(array.size(), value));
  return {};
}

/// The one number of an array, or that at an index of the flat array.
Value item(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("item", arguments, 0, 1);
  const auto& array = *self.as_object<ArrayObject>();
  if (arguments.size() == 0 && array.size() != 1)
    raise(ErrorKind::value, "can only convert an array of size 1 to a Python scalar");
  const std::int64_t wanted = arguments.size() == 0 ? 0 : index_of(arguments[0]);
  const std::int64_t size = static_cast<std::int64_t>(array.size()), place = wanted < 0 ? wanted + size : wanted;
  if (place < 0 || place >= size)
    raise(ErrorKind::index, fmt::format("index {} is out of bounds for size {}", wanted, size));
  return array_number(array.at(static_cast<std::size_t>(place)), array.type);
}

constexpr std::array making_table = {
    FunctionRow{"array", array},
    FunctionRow{"asarray", asarray},
    FunctionRow{"copy", copy},
    FunctionRow{"zeros", constant<0>},
    FunctionRow{"ones", constant<1>},
    FunctionRow{"empty", constant<0>},  // numpy's holds whatever was there
    FunctionRow{"full", full},
    FunctionRow{"zeros_like", constant_like<0>},
    FunctionRow{"ones_like", constant_like<1>},
    FunctionRow{"empty_like", constant_like<0>},
    FunctionRow{"full_like", full_like},
    FunctionRow{"eye", eye},
    FunctionRow{"identity", identity},
    FunctionRow{"linspace", linspace},
    FunctionRow{"logspace", logspace},
    FunctionRow{"arange", arange},
};

constexpr std::array making_method_table = {
    MethodRow{"tolist", tolist}, MethodRow{"copy", as_method<copy>},
    MethodRow{"astype", astype}, MethodRow{"fill", fill},
    MethodRow{"item", item},
};

}  // namespace

std::span<const FunctionRow> making_functions() { return making_table; }
std::span<const MethodRow> making_methods() { return making_method_table; }

}  // namespace comma::interpreter::numpy
