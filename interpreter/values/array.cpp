// What an array is: how one is made, what it shows, how it is written.
#include "interpreter/values/array.hpp"

#include <fmt/format.h>

#include <cmath>

#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

constexpr double largest_exact_integer = 9007199254740992.0;  // 2**53: the double format holds all integers up to there

void append_number(const Value& value, Numbers& numbers) {
  if (!is_numeric(value) || value.is_complex()) {
    raise(ErrorKind::type, fmt::format("an array is made of numbers, not of '{}'", value.type_name()), "use a list");
  }
  const NumberType own = value.is_bool()      ? NumberType::boolean
                         : is_integral(value) ? NumberType::integer
                                              : NumberType::real;
  numbers.type = std::max(numbers.type, own);
  numbers.data.push_back(real_of(value));
}

bool is_row(const Value& value) {
  return value.is_sequence() || value.as_object<ArrayObject>() != nullptr || value.as_object<RangeObject>() != nullptr;
}

void append_row(const Value& row, std::size_t width, Numbers& numbers, Meter& meter) {
  const std::vector<Value> items = list_of(row, meter);
  meter.allocate_items(items.size());
  if (items.size() != width) raise(ErrorKind::value, "the rows of an array have the same length");
  for (const Value& value : items) {
    if (is_row(value)) raise(ErrorKind::not_implemented, "arrays have one or two dimensions here, not three");
    append_number(value, numbers);
  }
}

std::vector<std::ptrdiff_t> row_major_strides(const Shape& shape) {
  std::vector<std::ptrdiff_t> strides(shape.size(), 1);
  if (shape.size() == 2) strides[0] = static_cast<std::ptrdiff_t>(shape[1]);
  return strides;
}

}  // namespace

std::string_view name_of(NumberType type) {
  return type == NumberType::real ? "float64" : type == NumberType::integer ? "int64" : "bool";
}

std::size_t size_of(const Shape& shape) {
  std::size_t size = 1;
  for (const std::size_t length : shape) size *= length;
  return size;
}

std::string text_of(const Shape& shape) {
  return shape.size() == 1 ? fmt::format("({},)", shape[0]) : fmt::format("({})", fmt::join(shape, ","));
}

Value array_number(double value, NumberType type) {
  if (type == NumberType::real) return Value(value);
  if (type == NumberType::boolean) return Value(value != 0.0);
  if (!(std::abs(value) <= largest_exact_integer))
    raise(ErrorKind::overflow, "an integer of an array lies beyond 2**53, where digits are lost",
          "compute with float, or without arrays");
  return Value(static_cast<std::int64_t>(value));
}

double converted(double value, NumberType type) {
  if (type == NumberType::real) return value;
  if (type == NumberType::boolean) return value != 0.0 ? 1.0 : 0.0;
  if (std::isnan(value)) raise(ErrorKind::value, "cannot convert float NaN to integer");
  return std::trunc(value) + 0.0;  // there is no negative zero among integers
}

Numbers converted(Numbers numbers, NumberType type) {
  if (type == numbers.type) return numbers;
  for (double& number : numbers.data) number = converted(number, type);
  numbers.type = type;
  return numbers;
}

double& ArrayObject::at(std::size_t index) const {
  const auto place = static_cast<std::ptrdiff_t>(index);
  if (shape.size() == 1) return (*buffer)[static_cast<std::size_t>(offset + place * strides[0])];
  const auto columns = static_cast<std::ptrdiff_t>(shape[1]);
  return (*buffer)[static_cast<std::size_t>(offset + place / columns * strides[0] + place % columns * strides[1])];
}

bool ArrayObject::is_contiguous() const {
  const auto expected = row_major_strides(shape);
  for (std::size_t axis = 0; axis < shape.size(); ++axis)
    if (shape[axis] > 1 && strides[axis] != expected[axis]) return false;
  return true;
}

Numbers ArrayObject::numbers() const {
  Numbers copy{std::vector<double>(size()), shape, type};
  for (std::size_t i = 0; i < copy.data.size(); ++i) copy.data[i] = at(i);
  return copy;
}

void ArrayObject::write(const std::vector<double>& data) {
  for (std::size_t i = 0; i < data.size(); ++i) at(i) = data[i];
}

Value ArrayObject::row(std::size_t index) const {
  if (shape.size() == 1) return array_number(at(index), type);
  return make_window(*this, offset + static_cast<std::ptrdiff_t>(index) * strides[0], {shape[1]}, {strides[1]});
}

Value ArrayObject::to_list() const {
  std::vector<Value> items;
  for (std::size_t i = 0; i < shape[0]; ++i) {
    const Value item = row(i);
    items.push_back(shape.size() == 1 ? item : item.as_object<ArrayObject>()->to_list());
  }
  return Value::list(std::move(items));
}

Numbers numbers_of(const Value& source, Meter& meter) {
  Numbers numbers;
  numbers.type = NumberType::boolean;
  if (const auto* array = source.as_object<ArrayObject>()) {
    meter.allocate(array->size() * sizeof(double));
    return array->numbers();
  }
  if (is_numeric(source)) {
    append_number(source, numbers);
    return numbers;
  }
  const std::vector<Value> rows = list_of(source, meter);
  meter.allocate_items(rows.size());
  numbers.shape = {rows.size()};
  if (!rows.empty() && is_row(rows[0])) {
    const auto width = static_cast<std::size_t>(length_of(rows[0]).value_or(0));
    numbers.shape.push_back(width);
    for (const Value& row : rows) {
      if (!is_row(row)) raise(ErrorKind::value, "the rows of an array have the same length");
      append_row(row, width, numbers, meter);
    }
  } else {
    for (const Value& value : rows) append_number(value, numbers);
  }
  if (numbers.data.empty()) numbers.type = NumberType::real;
  return numbers;
}

Value make_value(Numbers numbers) {
  if (numbers.shape.empty()) return array_number(numbers.data[0], numbers.type);
  if (numbers.shape.size() > 2)
    raise(ErrorKind::not_implemented,
          fmt::format("arrays have one or two dimensions here, not {}", numbers.shape.size()));
  auto array = std::make_shared<ArrayObject>();
  array->buffer = std::make_shared<std::vector<double>>(std::move(numbers.data));
  array->strides = row_major_strides(numbers.shape);
  array->shape = std::move(numbers.shape);
  array->type = numbers.type;
  return Value(std::shared_ptr<Object>(std::move(array)));
}

Value make_window(const ArrayObject& array, std::ptrdiff_t offset, Shape shape, std::vector<std::ptrdiff_t> strides) {
  if (shape.size() > 2)
    raise(ErrorKind::not_implemented, fmt::format("arrays have one or two dimensions here, not {}", shape.size()));
  auto window = std::make_shared<ArrayObject>();
  window->buffer = array.buffer;
  window->offset = offset;
  window->shape = std::move(shape);
  window->strides = std::move(strides);
  window->type = array.type;
  return Value(std::shared_ptr<Object>(std::move(window)));
}

Value transposed(const ArrayObject& array) {
  return make_window(array, array.offset, {array.shape.rbegin(), array.shape.rend()},
                     {array.strides.rbegin(), array.strides.rend()});
}

}  // namespace comma::interpreter
