// a[i], a[i, j], a[i:j], a[:, j], a[mask], a[[0, 2]], and what is written there. Whole numbers and slices give a window
// on the same numbers; masks and lists of indices pick numbers one by one.
#include <fmt/format.h>

#include <algorithm>

#include "interpreter/values/array.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

std::int64_t checked_index(const Value& index, std::size_t axis, std::size_t length) {
  if (!integer_of(index) || index.is_bool())
    raise(ErrorKind::index,
          fmt::format("arrays are indexed with integers and slices, not with '{}'", index.type_name()),
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

bool picks(const Value& part) {
  return part.is_sequence() || part.as_object<ArrayObject>() != nullptr || part.as_object<RangeObject>() != nullptr;
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
    if (part.is_none()) {
      window.shape.push_back(1);
      window.strides.push_back(0);
      continue;
    }
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

/// The indices along one axis that a part of the index stands for.
struct AxisPicks {
  Numbers places;
  bool spans = false;  ///< a slice: each of its places goes with each of the other axis
};

AxisPicks span_of_axis(std::size_t length, const SliceObject& slice) {
  const SliceRange range = resolve_slice(slice, static_cast<std::int64_t>(length));
  AxisPicks picked{{{}, {static_cast<std::size_t>(range.count)}, NumberType::integer}, true};
  for (std::int64_t i = 0; i < range.count; ++i)
    picked.places.data.push_back(static_cast<double>(range.start + i * range.step));
  return picked;
}

/// Where a mask is true, along each of the axes that it covers.
void append_mask(const ArrayObject& array, const Numbers& mask, std::vector<AxisPicks>& axes) {
  const std::size_t first = axes.size();
  for (std::size_t k = 0; k < mask.shape.size(); ++k) {
    require_axis(array, first + k);
    if (array.shape[first + k] != mask.shape[k])
      raise(ErrorKind::index,
            fmt::format("boolean index did not match indexed array along dimension {}; dimension is {} but "
                        "corresponding boolean dimension is {}",
                        first + k, array.shape[first + k], mask.shape[k]));
  }
  const auto count = static_cast<std::size_t>(std::ranges::count_if(mask.data, [](double set) { return set != 0.0; }));
  std::size_t stride = mask.data.size();
  for (const std::size_t length : mask.shape) {
    AxisPicks picked{{{}, {count}, NumberType::integer}, false};
    stride = length == 0 ? 0 : stride / length;
    for (std::size_t i = 0; i < mask.data.size(); ++i)
      if (mask.data[i] != 0.0) picked.places.data.push_back(static_cast<double>(i / stride % length));
    axes.push_back(std::move(picked));
  }
}

void append_indices(const ArrayObject& array, Numbers indices, std::vector<AxisPicks>& axes) {
  const std::size_t axis = axes.size();
  require_axis(array, axis);
  if (indices.type != NumberType::integer && !indices.data.empty())
    raise(ErrorKind::index, "arrays used as indices must be of integer (or boolean) type");
  for (double& index : indices.data)
    index = static_cast<double>(checked_index(array_number(index, NumberType::integer), axis, array.shape[axis]));
  axes.push_back({std::move(indices), false});
}

std::vector<AxisPicks> picks_at(const ArrayObject& array, const std::vector<Value>& parts, Meter& meter) {
  std::vector<AxisPicks> axes;
  for (const Value& part : parts) {
    if (part.is_none()) raise(ErrorKind::not_implemented, "newaxis together with lists of indices is not supported");
    if (!picks(part)) require_axis(array, axes.size());
    if (const auto* slice = part.as_object<SliceObject>()) {
      axes.push_back(span_of_axis(array.shape[axes.size()], *slice));
      continue;
    }
    if (!picks(part)) checked_index(part, axes.size(), array.shape[axes.size()]);
    Numbers indices = numbers_of(part, meter);
    if (indices.type == NumberType::boolean)
      append_mask(array, indices, axes);
    else
      append_indices(array, std::move(indices), axes);
  }
  while (axes.size() < array.shape.size()) axes.push_back(span_of_axis(array.shape[axes.size()], SliceObject{}));
  return axes;
}

/// Numbers picked one by one: where they lie in the buffer, and their shape.
struct Picked {
  std::vector<std::size_t> places;
  Shape shape;
};

Picked picked_at(const ArrayObject& array, const std::vector<Value>& parts, Meter& meter) {
  const std::vector<AxisPicks> axes = picks_at(array, parts, meter);
  Picked picked;
  const auto place = [&](double row, double column) {
    const auto along = [&](std::size_t axis, double index) {
      return static_cast<std::ptrdiff_t>(index) * array.strides[axis];
    };
    const std::ptrdiff_t behind = axes.size() == 2 ? along(1, column) : 0;
    picked.places.push_back(static_cast<std::size_t>(array.offset + along(0, row) + behind));
  };
  const Numbers& rows = axes[0].places;
  if (axes.size() == 1) {
    picked.shape = rows.shape;
    for (const double row : rows.data) place(row, 0.0);
    return picked;
  }
  const Numbers& columns = axes[1].places;
  if (!axes[0].spans && !axes[1].spans) {
    picked.shape = broadcast_shape(rows.shape, columns.shape);
    const std::vector<double> own_rows = spread(rows, picked.shape), own_columns = spread(columns, picked.shape);
    for (std::size_t i = 0; i < own_rows.size(); ++i) place(own_rows[i], own_columns[i]);
    return picked;
  }
  picked.shape = rows.shape;
  picked.shape.insert(picked.shape.end(), columns.shape.begin(), columns.shape.end());
  meter.allocate(rows.data.size() * columns.data.size() * sizeof(double));
  for (const double row : rows.data)
    for (const double column : columns.data) place(row, column);
  return picked;
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
    raise(ErrorKind::value, fmt::format("could not broadcast input array from shape {} into shape {}",
                                        text_of(numbers.shape), text_of(shape)));
  std::vector<double> data = spread({numbers.data, own, numbers.type}, shape);
  for (double& number : data) number = converted(number, type);
  return data;
}

}  // namespace

Value array_subscript(const ArrayObject& array, const Value& index, Meter& meter) {
  const std::vector<Value> parts = parts_of(index);
  if (std::ranges::any_of(parts, picks)) {
    Picked picked = picked_at(array, parts, meter);
    Numbers numbers{{}, std::move(picked.shape), array.type};
    for (const std::size_t place : picked.places) numbers.data.push_back((*array.buffer)[place]);
    return make_value(std::move(numbers));
  }
  Window window = window_at(array, parts);
  if (window.shape.empty()) return array_number((*array.buffer)[static_cast<std::size_t>(window.offset)], array.type);
  return make_window(array, window.offset, std::move(window.shape), std::move(window.strides));
}

void array_store(ArrayObject& array, const Value& index, const Value& value, Meter& meter) {
  if (value.is_unknown()) return;
  const std::vector<Value> parts = parts_of(index);
  // The numbers are taken before the first is written: they may be those of the same array.
  if (std::ranges::any_of(parts, picks)) {
    const Picked picked = picked_at(array, parts, meter);
    const std::vector<double> data = fitted(numbers_of(value, meter), picked.shape, array.type);
    for (std::size_t i = 0; i < data.size(); ++i) (*array.buffer)[picked.places[i]] = data[i];
    return;
  }
  const Window window = window_at(array, parts);
  const std::vector<double> data = fitted(numbers_of(value, meter), window.shape, array.type);
  if (window.shape.empty()) {
    (*array.buffer)[static_cast<std::size_t>(window.offset)] = data[0];
    return;
  }
  make_window(array, window.offset, window.shape, window.strides).as_object<ArrayObject>()->write(data);
}

}  // namespace comma::interpreter
