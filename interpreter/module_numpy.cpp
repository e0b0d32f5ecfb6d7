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

const ArrayObject& array_of(Evaluator& evaluator, const Value& value, Value& holder) {
  holder = value.as_object<ArrayObject>() != nullptr ? value : make_array(value, evaluator.meter());
  return *holder.as_object<ArrayObject>();
}

Value array(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("array", arguments, 1, 2, {"dtype"});
  const Value made = make_array(arguments[0], evaluator.meter());
  const Value* type = arguments.size() > 1 ? &arguments[1] : arguments.find("dtype");
  if (type != nullptr && !type->is_none()) {
    const auto* wanted = type->as_object<TypeObject>();
    if (wanted == nullptr || (wanted->name != "float" && wanted->name != "int"))
      raise(ErrorKind::not_implemented, "arrays are of int or float");
    auto* result = made.as_object<ArrayObject>();
    result->integers = wanted->name == "int";
    if (result->integers)
      std::transform(result->data.begin(), result->data.end(), result->data.begin(),
                     [](double x) { return std::trunc(x); });
  }
  return made;
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
  return make_array(std::vector<double>(size, value), std::move(shape), false);
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
  return make_array(std::move(data), {static_cast<std::size_t>(n)}, false);
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
  return make_array(std::move(data), {size}, integers);
}

template <double (*Function)(double)>
Value elementwise(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 1);
  if (is_numeric(arguments[0])) return Function(real_of(arguments[0]));
  Value holder;
  const ArrayObject& source = array_of(evaluator, arguments[0], holder);
  std::vector<double> data(source.data.size());
  std::transform(source.data.begin(), source.data.end(), data.begin(), Function);
  return make_array(std::move(data), source.shape, false);
}

Value array_sum(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("sum", arguments, 1, 1);
  Value holder;
  const ArrayObject& source = array_of(evaluator, arguments[0], holder);
  return array_number(std::accumulate(source.data.begin(), source.data.end(), 0.0), source.integers);
}

Value mean(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("mean", arguments, 1, 1);
  Value holder;
  const ArrayObject& source = array_of(evaluator, arguments[0], holder);
  return std::accumulate(source.data.begin(), source.data.end(), 0.0) / static_cast<double>(source.data.size());
}

Value array_extreme(Evaluator& evaluator, const CallArguments& arguments, bool largest, bool place) {
  expect_arguments("max", arguments, 1, 1);
  Value holder;
  const ArrayObject& source = array_of(evaluator, arguments[0], holder);
  if (source.data.empty()) raise(ErrorKind::value, "zero-size array to reduction operation which has no identity");
  const auto found = largest ? std::max_element(source.data.begin(), source.data.end())
                             : std::min_element(source.data.begin(), source.data.end());
  if (place) return static_cast<std::int64_t>(found - source.data.begin());
  return array_number(*found, source.integers);
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
  Value hold_a, hold_b;
  const ArrayObject& a = array_of(evaluator, arguments[0], hold_a);
  const ArrayObject& b = array_of(evaluator, arguments[1], hold_b);
  const std::size_t inner = a.shape.back();
  if (inner != b.shape.front()) raise(ErrorKind::value, "shapes not aligned");
  const std::size_t rows = a.shape.size() == 2 ? a.shape[0] : 1, columns = b.shape.size() == 2 ? b.shape[1] : 1;
  evaluator.meter().allocate(rows * columns * 8);
  std::vector<double> data(rows * columns, 0.0);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < inner; ++k) {
      for (std::size_t j = 0; j < columns; ++j)
        data[i * columns + j] += a.data[i * inner + k] * b.data[k * columns + j];
    }
  }
  const bool integers = a.integers && b.integers;
  std::vector<std::size_t> shape;
  if (a.shape.size() == 2) shape.push_back(rows);
  if (b.shape.size() == 2) shape.push_back(columns);
  if (shape.empty()) return array_number(data[0], integers);
  return make_array(std::move(data), std::move(shape), integers);
}

Value cross(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("cross", arguments, 2, 2);
  Value hold_a, hold_b;
  const ArrayObject& a = array_of(evaluator, arguments[0], hold_a);
  const ArrayObject& b = array_of(evaluator, arguments[1], hold_b);
  if (a.data.size() != 3 || b.data.size() != 3)
    raise(ErrorKind::value, "a cross product needs two vectors of three components");
  const auto& x = a.data;
  const auto& y = b.data;
  return make_array({x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]}, {3},
                    a.integers && b.integers);
}

Value norm(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("norm", arguments, 1, 1);
  Value holder;
  const ArrayObject& source = array_of(evaluator, arguments[0], holder);
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
  return make_array(self, evaluator.meter());
}

Value flatten(Evaluator&, const Value& self, const CallArguments&) {
  const auto* source = self.as_object<ArrayObject>();
  return make_array(source->data, {source->data.size()}, source->integers);
}

Value transpose(Evaluator&, const Value& self, const CallArguments&) { return transposed(*self.as_object<ArrayObject>()); }

Value transpose_of(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("transpose", arguments, 1, 1);
  Value holder;
  return transposed(array_of(evaluator, arguments[0], holder));
}

/// Arrays one after the other, or their rows.
Value concatenate(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("concatenate", arguments, 1, 1);
  if (!arguments[0].is_sequence() || arguments[0].items().empty()) raise(ErrorKind::value, "need at least one array to concatenate");
  std::vector<double> data;
  std::vector<std::size_t> shape;
  bool integers = true;
  for (const Value& part : arguments[0].items()) {
    Value holder;
    const ArrayObject& source = array_of(evaluator, part, holder);
    if (shape.empty()) {
      shape = source.shape;
      shape.front() = 0;
    }
    if (source.shape.size() != shape.size() || source.shape.back() != (shape.size() == 2 ? shape.back() : source.shape.back()))
      raise(ErrorKind::value, "all the input array dimensions except for the concatenation axis must match exactly");
    shape.front() += source.shape.front();
    evaluator.meter().allocate(source.data.size() * sizeof(double));
    data.insert(data.end(), source.data.begin(), source.data.end());
    integers = integers && source.integers;
  }
  return make_array(std::move(data), std::move(shape), integers);
}

constexpr std::array array_function_table = {
    FunctionRow{"array", array},
    FunctionRow{"asarray", array},
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
    MethodRow{"ravel", flatten},
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
