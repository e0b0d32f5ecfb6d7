// The part of numpy that command files use: how its functions read their arguments, and the tables put together.
#include <fmt/format.h>

#include <algorithm>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/dtype.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace numpy {

Numbers argument(Evaluator& evaluator, const Value& value) { return numbers_of(value, evaluator.meter()); }

Numbers array_argument(Evaluator& evaluator, const Value& value) {
  Numbers numbers = argument(evaluator, value);
  if (numbers.shape.empty())
    raise(ErrorKind::not_implemented, "an array of one or two dimensions is wanted here, not a number");
  return numbers;
}

const Value* option(const CallArguments& arguments, std::size_t position, std::string_view name) {
  return arguments.size() > position ? &arguments[position] : arguments.find(name);
}

std::optional<NumberType> type_argument(const CallArguments& arguments, std::size_t position) {
  const Value* word = option(arguments, position, "dtype");
  return word == nullptr ? std::nullopt : number_type_of(*word);
}

std::optional<std::size_t> axis_argument(const CallArguments& arguments, std::size_t position, std::size_t dimensions) {
  const Value* given = option(arguments, position, "axis");
  if (given == nullptr || given->is_none()) return std::nullopt;
  const std::int64_t wanted = index_of(*given), count = static_cast<std::int64_t>(dimensions);
  if (wanted < -count || wanted >= count)
    raise(ErrorKind::value, fmt::format("axis {} is out of bounds for array of dimension {}", wanted, dimensions));
  return static_cast<std::size_t>(wanted < 0 ? wanted + count : wanted);
}

Numbers map_lines(const Numbers& source, std::size_t axis, const LineFunction& function) {
  const bool down = source.shape.size() == 2 && axis == 0;
  const std::size_t length = source.shape[axis];
  const std::size_t count = source.shape.size() == 1 ? 1 : source.shape[1 - axis];
  Numbers result{{}, source.shape, source.type};
  std::vector<double> line(length);
  std::vector<std::vector<double>> made;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < length; ++i) line[i] = source.data[down ? i * count + k : k * length + i];
    made.push_back(function(line));
  }
  const std::size_t new_length = made.empty() ? length : made[0].size();
  result.shape[axis] = new_length;
  result.data.resize(count * new_length);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < new_length; ++i) result.data[down ? i * count + k : k * new_length + i] = made[k][i];
  return result;
}

Numbers flattened(Numbers numbers) {
  numbers.shape = {numbers.data.size()};
  return numbers;
}

}  // namespace numpy

std::vector<FunctionRow> numpy_functions() {
  std::vector<FunctionRow> rows;
  for (const auto part : {numpy::making_functions(), numpy::element_functions(), numpy::reducing_functions(),
                          numpy::shape_functions(), numpy::curve_functions(), numpy::matrix_functions()})
    rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

std::span<const FunctionRow> linalg_functions() { return numpy::linalg_table(); }

std::span<const MethodRow> array_methods() {
  static const std::vector<MethodRow> all = [] {
    std::vector<MethodRow> rows;
    for (const auto part : {numpy::making_methods(), numpy::element_methods(), numpy::reducing_methods(),
                            numpy::shape_methods(), numpy::matrix_methods()})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return all;
}

}  // namespace comma::interpreter
