#include "interpreter/array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/operations.hpp"
#include "interpreter/repr.hpp"

namespace comma::interpreter {

namespace {

constexpr double largest_exact_integer = 9007199254740992.0;  // 2**53: the double format holds all integers up to there

void append_number(const Value& value, std::vector<double>& data, bool& integers) {
  if (!is_numeric(value) || value.is_complex()) {
    raise(ErrorKind::type, fmt::format("an array is made of numbers, not of '{}'", value.type_name()), "use a list");
  }
  integers = integers && is_integral(value);
  data.push_back(real_of(value));
}

/// A number, or an array, or what an array can be made of.
struct Operand {
  const std::vector<double>* data = nullptr;
  std::vector<std::size_t> shape;
  double number = 0.0;
  bool integers = false;
  double at(std::size_t i) const { return data != nullptr ? (*data)[i] : number; }
};

Operand operand_of(const Value& value, Value& holder, Meter& meter) {
  Operand operand;
  if (is_numeric(value)) {
    operand.number = real_of(value);
    operand.integers = is_integral(value);
    return operand;
  }
  holder = value.as_object<ArrayObject>() != nullptr ? value : make_array(value, meter);
  const auto* array = holder.as_object<ArrayObject>();
  operand.data = &array->data;
  operand.shape = array->shape;
  operand.integers = array->integers;
  return operand;
}

double apply(Operator op, double a, double b) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::floor_divide:
      return std::floor(a / b);
    case Operator::modulo:
      return a - b * std::floor(a / b);
    case Operator::power:
      return std::pow(a, b);
    case Operator::less:
      return a < b ? 1.0 : 0.0;
    case Operator::less_equal:
      return a <= b ? 1.0 : 0.0;
    case Operator::greater:
      return a > b ? 1.0 : 0.0;
    case Operator::greater_equal:
      return a >= b ? 1.0 : 0.0;
    case Operator::equal:
      return a == b ? 1.0 : 0.0;
    case Operator::not_equal:
      return a != b ? 1.0 : 0.0;
    default:
      raise(ErrorKind::type, fmt::format("arrays have no operator {} here", symbol_of(op)));
  }
}

/// What integers have no integer for: numpy refuses such a power, and makes zeros of such quotients with a warning.
void require_whole(Operator op, const std::vector<double>& values) {
  for (const double value : values) {
    if (op == Operator::power && value != std::trunc(value))
      raise(ErrorKind::value, "Integers to negative integer powers are not allowed.", "take an array of float");
    if ((op == Operator::floor_divide || op == Operator::modulo) && !std::isfinite(value))
      raise(ErrorKind::zero_division, "integer division or modulo by zero");
  }
}

std::size_t row_length(const ArrayObject& array) {
  return array.shape.size() == 2 ? array.shape[1] : 1;
}

std::int64_t checked_index(const Value& index, std::size_t length) {
  const std::int64_t wanted = index_of(index);
  const std::int64_t place = wanted < 0 ? wanted + static_cast<std::int64_t>(length) : wanted;
  if (place < 0 || place >= static_cast<std::int64_t>(length)) {
    raise(ErrorKind::index, fmt::format("index {} is out of bounds for axis 0 with size {}", wanted, length));
  }
  return place;
}

/// The places along one axis that an index or a slice selects.
struct Selection {
  std::vector<std::size_t> places;
  bool keeps_axis = true;
};

Selection select(const Value& index, std::size_t length) {
  Selection selection;
  if (const auto* slice = index.as_object<SliceObject>()) {
    const SliceRange range = resolve_slice(*slice, static_cast<std::int64_t>(length));
    for (std::int64_t i = 0; i < range.count; ++i)
      selection.places.push_back(static_cast<std::size_t>(range.start + i * range.step));
    return selection;
  }
  selection.places.push_back(static_cast<std::size_t>(checked_index(index, length)));
  selection.keeps_axis = false;
  return selection;
}

struct Selected {
  std::vector<std::size_t> places;  ///< in the flat data
  std::vector<std::size_t> shape;
};

Selected select(const ArrayObject& array, const Value& index) {
  const bool pair = index.is_tuple();
  if (pair && index.items().size() > array.shape.size()) {
    raise(ErrorKind::index, fmt::format("too many indices for array: array is {}-dimensional", array.shape.size()));
  }
  const Selection rows = select(pair ? index.items()[0] : index, array.shape[0]);
  Selected selected;
  if (rows.keeps_axis) selected.shape.push_back(rows.places.size());
  Selection columns;
  columns.keeps_axis = array.shape.size() == 2;
  if (pair && index.items().size() == 2) {
    columns = select(index.items()[1], array.shape[1]);
  } else {
    for (std::size_t j = 0; j < row_length(array); ++j) columns.places.push_back(j);
  }
  if (columns.keeps_axis) selected.shape.push_back(columns.places.size());
  for (std::size_t i : rows.places) {
    for (std::size_t j : columns.places) selected.places.push_back(i * row_length(array) + j);
  }
  return selected;
}

}  // namespace

Value make_array(std::vector<double> data, std::vector<std::size_t> shape, bool integers) {
  auto array = std::make_shared<ArrayObject>();
  array->data = std::move(data);
  array->shape = std::move(shape);
  array->integers = integers;
  return Value(std::shared_ptr<Object>(std::move(array)));
}

Value make_array(const Value& source, Meter& meter) {
  if (const auto* array = source.as_object<ArrayObject>())
    return make_array(array->data, array->shape, array->integers);
  std::vector<double> data;
  bool integers = true;
  const std::vector<Value> rows = list_of(source, meter);
  meter.allocate_items(rows.size());
  const bool nested = !rows.empty() && (rows[0].is_sequence() || rows[0].as_object<ArrayObject>() != nullptr);
  if (!nested) {
    for (const Value& value : rows) append_number(value, data, integers);
    const std::size_t length = data.size();
    return make_array(std::move(data), {length}, integers && length > 0);
  }
  const std::size_t width = static_cast<std::size_t>(length_of(rows[0]).value_or(0));
  for (const Value& row : rows) {
    const std::vector<Value> items = list_of(row, meter);
    meter.allocate_items(items.size());
    if (items.size() != width) raise(ErrorKind::value, "the rows of an array have the same length");
    for (const Value& value : items) append_number(value, data, integers);
  }
  return make_array(std::move(data), {rows.size(), width}, integers);
}

Value array_number(double value, bool integers) {
  if (!integers) return Value(value);
  if (!(std::abs(value) <= largest_exact_integer))
    raise(ErrorKind::overflow, "an integer of an array lies beyond 2**53, where digits are lost", "compute with float, or without arrays");
  return Value(static_cast<std::int64_t>(value));
}

Value ArrayObject::item(std::size_t index) const { return array_number(data[index], integers); }

Value ArrayObject::rows() const {
  std::vector<Value> items;
  for (std::size_t i = 0; i < shape[0]; ++i) {
    if (shape.size() == 1) {
      items.push_back(item(i));
      continue;
    }
    const auto first = data.begin() + static_cast<std::ptrdiff_t>(i * shape[1]);
    items.push_back(make_array({first, first + static_cast<std::ptrdiff_t>(shape[1])}, {shape[1]}, integers));
  }
  return Value::list(std::move(items));
}

Value ArrayObject::to_list() const {
  if (shape.size() == 1) return rows();
  std::vector<Value> lists;
  const Value all = rows();
  for (const Value& row : all.items()) lists.push_back(row.as_object<ArrayObject>()->to_list());
  return Value::list(std::move(lists));
}

std::string ArrayObject::repr() const {
  return "array(" + to_list().repr() + ")";
}

Value array_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  Value hold_a, hold_b;
  const Operand x = operand_of(a, hold_a, meter);
  const Operand y = operand_of(b, hold_b, meter);
  const auto& shape = x.data != nullptr ? x.shape : y.shape;
  if (x.data != nullptr && y.data != nullptr && x.shape != y.shape)
    raise(ErrorKind::value, "operands could not be broadcast together");
  const std::size_t size = x.data != nullptr ? x.data->size() : y.data->size();
  meter.allocate(size * sizeof(double));
  std::vector<double> result(size);
  for (std::size_t i = 0; i < size; ++i) result[i] = apply(op, x.at(i), y.at(i));
  const bool compares = op >= Operator::less;
  const bool integers = x.integers && y.integers && op != Operator::divide;
  if (integers && !compares) require_whole(op, result);
  return make_array(std::move(result), shape, compares || integers);
}

Value transposed(const ArrayObject& array) {
  if (array.shape.size() == 1) return make_array(array.data, array.shape, array.integers);
  const std::size_t rows = array.shape[0], columns = array.shape[1];
  std::vector<double> data(array.data.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) data[j * rows + i] = array.data[i * columns + j];
  return make_array(std::move(data), {columns, rows}, array.integers);
}

Value array_subscript(const ArrayObject& array, const Value& index) {
  Selected selected = select(array, index);
  if (selected.shape.empty()) return array.item(selected.places[0]);
  std::vector<double> data;
  for (std::size_t place : selected.places) data.push_back(array.data[place]);
  return make_array(std::move(data), std::move(selected.shape), array.integers);
}

void array_store(ArrayObject& array, const Value& index, const Value& value) {
  const Selected selected = select(array, index);
  Meter meter{Limits{}};
  Value holder;
  const Operand operand = operand_of(value, holder, meter);
  if (operand.data != nullptr && operand.data->size() != selected.places.size()) {
    raise(ErrorKind::value, "could not broadcast input array into shape");
  }
  for (std::size_t i = 0; i < selected.places.size(); ++i) {
    const double number = operand.at(i);
    array.data[selected.places[i]] = array.integers ? std::trunc(number) : number;
  }
}

}  // namespace comma::interpreter
