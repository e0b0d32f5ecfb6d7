// numpy's functions that turn arrays round, cut them and put them together.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

/// The array itself, or one made of a sequence.
Value as_array(Evaluator& evaluator, const Value& value) {
  return value.as_object<ArrayObject>() != nullptr ? value : make_value(array_argument(evaluator, value));
}

/// The lengths that reshape is asked for, given as one tuple or one by one; -1 stands for what is left.
Shape new_shape(Evaluator& evaluator, std::span<const Value> given, std::size_t size) {
  std::vector<Value> lengths(given.begin(), given.end());
  if (lengths.size() == 1 && !lengths[0].is_integer()) lengths = list_of(lengths[0], evaluator.meter());
  if (lengths.empty() || lengths.size() > 2)
    raise(ErrorKind::not_implemented, fmt::format("arrays have one or two dimensions here, not {}", lengths.size()));
  std::vector<std::int64_t> wanted;
  for (const Value& length : lengths) wanted.push_back(index_of(length));
  const auto open = std::ranges::count_if(wanted, [](std::int64_t n) { return n < 0; });
  if (open > 1) raise(ErrorKind::value, "can only specify one unknown dimension");
  constexpr std::int64_t too_long = std::int64_t{1} << 31;
  std::int64_t known = 1;
  for (const std::int64_t n : wanted) known *= n < 0 ? 1 : std::min(n, too_long);
  const auto count = static_cast<std::int64_t>(size);
  const bool fits = open == 0 ? known == count : known > 0 && count % known == 0;
  if (!fits)
    raise(ErrorKind::value,
          fmt::format("cannot reshape array of size {} into shape ({})", size, fmt::join(wanted, ",")));
  Shape shape;
  for (const std::int64_t n : wanted) shape.push_back(static_cast<std::size_t>(n < 0 ? count / known : n));
  return shape;
}

/// What lies evenly spaced is shown in the new shape; everything else has to be copied.
Value reshaped(Evaluator& evaluator, const ArrayObject& array, const Shape& shape) {
  const bool two = array.shape.size() == 2;
  if (array.shape == shape) return make_window(array, array.offset, array.shape, array.strides);
  std::ptrdiff_t step = array.strides.back();
  bool even = true;
  if (two && array.shape[1] == 1) step = array.strides[0];
  if (two && array.shape[0] > 1 && array.shape[1] > 1)
    even = array.strides[0] == step * static_cast<std::ptrdiff_t>(array.shape[1]);
  if (!even) {
    Numbers numbers = argument(evaluator, make_window(array, array.offset, array.shape, array.strides));
    numbers.shape = shape;
    return make_value(std::move(numbers));
  }
  std::vector<std::ptrdiff_t> strides(shape.size(), step);
  if (shape.size() == 2) strides[0] = step * static_cast<std::ptrdiff_t>(shape[1]);
  return make_window(array, array.offset, shape, std::move(strides));
}

Value reshape(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("reshape", arguments, 2, 2);
  const Value array = as_array(evaluator, arguments[0]);
  const auto& source = *array.as_object<ArrayObject>();
  return reshaped(evaluator, source, new_shape(evaluator, std::span(arguments.positional).subspan(1), source.size()));
}

Value flatten(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("flatten", arguments, 1, 1);
  return make_value(flattened(array_argument(evaluator, arguments[0])));
}

Value ravel(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("ravel", arguments, 1, 1);
  const Value array = as_array(evaluator, arguments[0]);
  const auto& source = *array.as_object<ArrayObject>();
  if (!source.is_contiguous()) return flatten(evaluator, arguments);
  return make_window(source, source.offset, {source.size()}, {1});
}

Value transpose(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("transpose", arguments, 1, 1);
  const Value array = as_array(evaluator, arguments[0]);
  return transposed(*array.as_object<ArrayObject>());
}

std::vector<Numbers> parts_argument(Evaluator& evaluator, const Value& given) {
  std::vector<Numbers> parts;
  for (const Value& part : list_of(given, evaluator.meter())) parts.push_back(argument(evaluator, part));
  if (parts.empty()) raise(ErrorKind::value, "need at least one array to concatenate");
  return parts;
}

/// One after the other along an axis.
Value joined(const std::vector<Numbers>& parts, std::size_t axis) {
  Numbers result{{}, parts[0].shape, NumberType::boolean};
  result.shape[axis] = 0;
  for (const Numbers& part : parts) {
    Shape rest = part.shape, wanted = result.shape;
    if (rest.size() == wanted.size()) rest[axis] = wanted[axis] = 0;
    if (rest != wanted)
      raise(ErrorKind::value, "all the input array dimensions except for the concatenation axis must match exactly");
    result.shape[axis] += part.shape[axis];
    result.type = std::max(result.type, part.type);
  }
  const std::size_t rows = axis == 1 ? result.shape[0] : 1;
  for (std::size_t i = 0; i < rows; ++i) {
    for (const Numbers& part : parts) {
      const auto length = static_cast<std::ptrdiff_t>(part.data.size() / rows);
      const auto first = part.data.begin() + static_cast<std::ptrdiff_t>(i) * length;
      result.data.insert(result.data.end(), first, first + length);
    }
  }
  return make_value(std::move(result));
}

Value concatenate_arrays(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("concatenate", arguments, 1, 2, {"axis"});
  std::vector<Numbers> parts = parts_argument(evaluator, arguments[0]);
  for (const Numbers& part : parts)
    if (part.shape.empty()) raise(ErrorKind::value, "zero-dimensional arrays cannot be concatenated");
  const bool flat = option(arguments, 1, "axis") != nullptr && option(arguments, 1, "axis")->is_none();
  if (flat)
    for (Numbers& part : parts) part = flattened(std::move(part));
  return joined(parts, axis_argument(arguments, 1, parts[0].shape.size()).value_or(0));
}

Value vstack(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("vstack", arguments, 1, 1);
  std::vector<Numbers> parts = parts_argument(evaluator, arguments[0]);
  for (Numbers& part : parts)
    if (part.shape.size() < 2) part.shape = {1, part.data.size()};
  return joined(parts, 0);
}

Value hstack(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("hstack", arguments, 1, 1);
  std::vector<Numbers> parts = parts_argument(evaluator, arguments[0]);
  for (Numbers& part : parts)
    if (part.shape.empty()) part.shape = {1};
  return joined(parts, parts[0].shape.size() - 1);
}

Value column_stack(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("column_stack", arguments, 1, 1);
  std::vector<Numbers> parts = parts_argument(evaluator, arguments[0]);
  for (Numbers& part : parts)
    if (part.shape.size() < 2) part.shape = {part.data.size(), 1};
  return joined(parts, 1);
}

Value append_array(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("append", arguments, 2, 3, {"axis"});
  std::vector<Numbers> parts = {argument(evaluator, arguments[0]), argument(evaluator, arguments[1])};
  const auto axis = axis_argument(arguments, 2, parts[0].shape.size());
  if (!axis)
    for (Numbers& part : parts) part = flattened(std::move(part));
  return joined(parts, axis.value_or(0));
}

/// The k-th diagonal of a matrix as row and column of its first place, and how many places it has.
struct Diagonal {
  std::size_t row = 0, column = 0, count = 0;
};

Diagonal diagonal_of(const Shape& shape, std::int64_t k) {
  const auto shift = static_cast<std::size_t>(std::abs(k));
  Diagonal diagonal{k < 0 ? shift : 0, k > 0 ? shift : 0, 0};
  if (diagonal.row < shape[0] && diagonal.column < shape[1])
    diagonal.count = std::min(shape[0] - diagonal.row, shape[1] - diagonal.column);
  return diagonal;
}

std::int64_t diagonal_argument(const CallArguments& arguments, std::string_view name) {
  const Value* given = option(arguments, 1, name);
  const std::int64_t k = given != nullptr ? index_of(*given) : 0;
  constexpr std::int64_t farthest = std::int64_t{1} << 31;
  return std::clamp(k, -farthest, farthest);
}

/// Of a matrix its diagonal, of a vector the matrix that has it as diagonal.
Value diag(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("diag", arguments, 1, 2, {"k"});
  const Numbers source = array_argument(evaluator, arguments[0]);
  const std::int64_t k = diagonal_argument(arguments, "k");
  const bool takes = source.shape.size() == 2;
  const std::uint64_t length = source.data.size() + static_cast<std::uint64_t>(std::abs(k));
  if (!takes) evaluator.meter().allocate(std::min<std::uint64_t>(length * length, 1ULL << 50) * sizeof(double));
  Numbers result{{}, {source.data.size()}, source.type};
  if (!takes) result = {std::vector<double>(length * length, 0.0), {length, length}, source.type};
  const Shape matrix = takes ? source.shape : result.shape;
  const Diagonal diagonal = diagonal_of(matrix, k);
  for (std::size_t i = 0; i < diagonal.count; ++i) {
    const std::size_t place = (diagonal.row + i) * matrix[1] + diagonal.column + i;
    if (takes)
      result.data.push_back(source.data[place]);
    else
      result.data[place] = source.data[i];
  }
  return make_value(takes ? flattened(std::move(result)) : std::move(result));
}

Value trace(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("trace", arguments, 1, 2, {"offset"});
  const Numbers source = array_argument(evaluator, arguments[0]);
  if (source.shape.size() != 2) raise(ErrorKind::value, "diag requires an array of at least two dimensions");
  const Diagonal diagonal = diagonal_of(source.shape, diagonal_argument(arguments, "offset"));
  double total = 0.0;
  for (std::size_t i = 0; i < diagonal.count; ++i)
    total += source.data[(diagonal.row + i) * source.shape[1] + diagonal.column + i];
  return array_number(total, std::max(source.type, NumberType::integer));
}

Value reshape_method(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("reshape", arguments, 1, 2);
  const auto& source = *self.as_object<ArrayObject>();
  return reshaped(evaluator, source, new_shape(evaluator, arguments.positional, source.size()));
}

constexpr std::array shape_table = {
    FunctionRow{"reshape", reshape},
    FunctionRow{"ravel", ravel},
    FunctionRow{"transpose", transpose},
    FunctionRow{"concatenate", concatenate_arrays},
    FunctionRow{"vstack", vstack},
    FunctionRow{"hstack", hstack},
    FunctionRow{"column_stack", column_stack},
    FunctionRow{"append", append_array},
    FunctionRow{"diag", diag},
    FunctionRow{"trace", trace},
};

constexpr std::array shape_method_table = {
    MethodRow{"reshape", reshape_method}, MethodRow{"flatten", as_method<flatten>},
    MethodRow{"ravel", as_method<ravel>}, MethodRow{"transpose", as_method<transpose>},
    MethodRow{"trace", as_method<trace>},
};

}  // namespace

std::span<const FunctionRow> shape_functions() { return shape_table; }
std::span<const MethodRow> shape_methods() { return shape_method_table; }

}  // namespace comma::interpreter::numpy
