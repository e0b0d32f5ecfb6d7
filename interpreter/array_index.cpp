// a[i], a[i, j], a[i:j], a[:, j], and what is written there. Whole numbers and slices give a window on the same numbers.
#include <fmt/format.h>

#include "interpreter/array.hpp"
#include "interpreter/operations.hpp"

namespace comma::interpreter {

namespace {

std::int64_t checked_index(const Value& index, std::size_t axis, std::size_t length) {
  if (!integer_of(index) || index.is_bool())
    raise(ErrorKind::index, fmt::format("arrays are indexed with integers and slices, not with '{}'", index.type_name()),
          index.is_real() ? "divide with // or convert with int(...)" : "");
  const std::int64_t wanted = index_of(index);
  const std::int64_t place = wanted < 0 ? wanted + static_cast<std::int64_t>(length) : wanted;
  if (place < 0 || place >= static_cast<std::int64_t>(length))
    raise(ErrorKind::index, fmt::format("index {} is out of bounds for axis {} with size {}", wanted, axis, length));
  return place;
}

std::vector<Value> parts_of(const Value& index) {
  if (!index.is_tuple()) return {index};
  return {index.items().begin(), index.items().end()};
}

void require_axis(const ArrayObject& array, std::size_t indexed) {
  if (indexed >= array.shape.size())
    raise(ErrorKind::index, fmt::format("too many indices for array: array is {}-dimensional", array.shape.size()));
}

/// What whole numbers and slices select; without lengths it is one number.
struct Window {
  std::ptrdiff_t offset = 0;
  Shape shape;
  std::vector<std::ptrdiff_t> strides;
};

Window window_at(const ArrayObject& array, const std::vector<Value>& parts) {
  Window window{array.offset, {}, {}};
  std::size_t axis = 0;
  for (const Value& part : parts) {
    require_axis(array, axis);
    const std::ptrdiff_t stride = array.strides[axis];
    const std::size_t length = array.shape[axis];
    if (const auto* slice = part.as_object<SliceObject>()) {
      const SliceRange range = resolve_slice(*slice, static_cast<std::int64_t>(length));
      if (range.count > 0) window.offset += range.start * stride;
      window.shape.push_back(static_cast<std::size_t>(range.count));
      window.strides.push_back(range.step * stride);
    } else {
      window.offset += checked_index(part, axis, length) * stride;
    }
    ++axis;
  }
  for (; axis < array.shape.size(); ++axis) {
    window.shape.push_back(array.shape[axis]);
    window.strides.push_back(array.strides[axis]);
  }
  return window;
}

/// Row-major numbers as they go into a place of this shape.
std::vector<double> fitted(const Numbers& numbers, const Shape& shape, NumberType type) {
  Shape own = numbers.shape;
  while (own.size() > shape.size() && own.front() == 1) own.erase(own.begin());
  bool fits = own.size() <= shape.size();
  for (std::size_t k = 1; fits && k <= own.size(); ++k) {
    const std::size_t length = own[own.size() - k];
    fits = length == 1 || length == shape[shape.size() - k];
  }
  if (!fits)
    raise(ErrorKind::value, fmt::format("could not broadcast input array from shape {} into shape {}", text_of(numbers.shape), text_of(shape)));
  std::vector<double> data = spread({numbers.data, own, numbers.type}, shape);
  for (double& number : data) number = converted(number, type);
  return data;
}

}  // namespace

Value array_subscript(const ArrayObject& array, const Value& index, Meter&) {
  Window window = window_at(array, parts_of(index));
  if (window.shape.empty()) return array_number((*array.buffer)[static_cast<std::size_t>(window.offset)], array.type);
  return make_window(array, window.offset, std::move(window.shape), std::move(window.strides));
}

void array_store(ArrayObject& array, const Value& index, const Value& value, Meter& meter) {
  if (value.is_unknown()) return;
  const Window window = window_at(array, parts_of(index));
  // The numbers are taken before the first is written: they may be those of the same array.
  const std::vector<double> data = fitted(numbers_of(value, meter), window.shape, array.type);
  if (window.shape.empty()) {
    (*array.buffer)[static_cast<std::size_t>(window.offset)] = data[0];
    return;
  }
  make_window(array, window.offset, window.shape, window.strides).as_object<ArrayObject>()->write(data);
}

}  // namespace comma::interpreter
