// a[i], a[i:j:k], and what is written into them.
#include <fmt/format.h>

#include <algorithm>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

std::string_view word_for(const Value& value) {
  if (value.is_text()) return "string";
  if (value.is_list()) return "list";
  if (value.is_tuple()) return "tuple";
  return "range object";
}

std::int64_t checked_index(const Value& object, const Value& index, std::int64_t length, std::string_view action = "") {
  if (!integer_of(index)) {
    raise(ErrorKind::type,
          fmt::format("{} indices must be integers or slices, not {}", word_for(object), index.type_name()),
          index.is_real() ? "divide with // or convert with int(...)" : "");
  }
  const std::int64_t wanted = index.is_big_integer() ? length : index_of(index);
  const std::int64_t place = wanted < 0 ? wanted + length : wanted;
  if (place < 0 || place >= length) {
    raise(ErrorKind::index, fmt::format("{}{} index out of range", word_for(object), action),
          length == 0   ? "it is empty"
          : length == 1 ? "it has one item, whose index is 0"
                        : fmt::format("it has {} items: the indices go from 0 to {}", length, length - 1));
  }
  return place;
}

std::int64_t clamp_bound(const Value& bound, std::int64_t length, std::int64_t fallback, std::int64_t lowest,
                         std::int64_t highest) {
  if (bound.is_none()) return fallback;
  const auto number = integer_of(bound);
  if (!number) raise(ErrorKind::type, "slice indices must be integers or None or have an __index__ method");
  if (!number->fits_int64()) return number->is_negative() ? lowest : highest;
  std::int64_t place = number->to_int64();
  if (place < 0) place += length;
  return std::clamp(place, lowest, highest);
}

Value text_slice(const std::string& text, const SliceObject& slice) {
  const auto points = decode_utf8(text);
  const SliceRange range = resolve_slice(slice, static_cast<std::int64_t>(points.size()));
  std::string out;
  for (std::int64_t i = 0; i < range.count; ++i)
    append_utf8(out, points[static_cast<std::size_t>(range.start + i * range.step)]);
  return out;
}

Value sequence_slice(const Value& sequence, const SliceObject& slice, Meter& meter) {
  const auto items = sequence.items();
  const SliceRange range = resolve_slice(slice, static_cast<std::int64_t>(items.size()));
  meter.allocate_items(static_cast<std::uint64_t>(range.count));
  std::vector<Value> out;
  out.reserve(static_cast<std::size_t>(range.count));
  for (std::int64_t i = 0; i < range.count; ++i)
    out.push_back(items[static_cast<std::size_t>(range.start + i * range.step)]);
  return sequence.is_list() ? Value::list(std::move(out)) : Value::tuple(std::move(out));
}

Value text_item(const Value& object, const Value& index) {
  const std::string& text = object.as_text();
  if (is_ascii(text)) {
    return std::string(
        1, text[static_cast<std::size_t>(checked_index(object, index, static_cast<std::int64_t>(text.size())))]);
  }
  const auto points = decode_utf8(text);
  std::string out;
  append_utf8(out,
              points[static_cast<std::size_t>(checked_index(object, index, static_cast<std::int64_t>(points.size())))]);
  return out;
}

Value dict_item(const Dict& dict, const Value& index) {
  if (const Value* value = dict.find(index)) return *value;
  auto error = make_exception(ErrorKind::key, "");
  error->arguments = {index};
  if (index.is_text()) {
    std::vector<std::string> names;
    for (const Value& key : dict.keys()) {
      if (key.is_text()) names.push_back(key.as_text());
    }
    if (const std::string near = nearest(index.as_text(), names); !near.empty())
      error->hint = fmt::format("did you mean '{}'?", near);
  }
  throw RaisedError(std::move(error));
}

void store_slice(std::vector<Value>& items, const SliceObject& slice, const Value& value, Meter& meter) {
  const SliceRange range = resolve_slice(slice, static_cast<std::int64_t>(items.size()));
  std::vector<Value> fresh = list_of(value, meter);
  meter.allocate_items(items.size() + fresh.size());
  if (range.step == 1) {
    const auto first = items.begin() + range.start;
    const auto after = items.erase(first, first + range.count);
    items.insert(after, fresh.begin(), fresh.end());
    return;
  }
  if (static_cast<std::int64_t>(fresh.size()) != range.count) {
    raise(ErrorKind::value,
          fmt::format("attempt to assign sequence of size {} to extended slice of size {}", fresh.size(), range.count));
  }
  for (std::int64_t i = 0; i < range.count; ++i)
    items[static_cast<std::size_t>(range.start + i * range.step)] = fresh[static_cast<std::size_t>(i)];
}

}  // namespace

SliceRange resolve_slice(const SliceObject& slice, std::int64_t length) {
  std::int64_t step = 1;
  if (!slice.step.is_none()) {
    const auto number = integer_of(slice.step);
    if (!number) raise(ErrorKind::type, "slice indices must be integers or None or have an __index__ method");
    const std::int64_t largest = std::int64_t{1} << 40;
    step = number->fits_int64()    ? std::clamp(number->to_int64(), -largest, largest)
           : number->is_negative() ? -largest
                                   : largest;
  }
  if (step == 0) raise(ErrorKind::value, "slice step cannot be zero");
  SliceRange range{0, step, 0};
  if (step > 0) {
    range.start = clamp_bound(slice.start, length, 0, 0, length);
    const std::int64_t stop = clamp_bound(slice.stop, length, length, 0, length);
    range.count = stop > range.start ? (stop - range.start - 1) / step + 1 : 0;
  } else {
    range.start = clamp_bound(slice.start, length, length - 1, -1, length - 1);
    const std::int64_t stop = clamp_bound(slice.stop, length, -1, -1, length - 1);
    range.count = stop < range.start ? (range.start - stop - 1) / -step + 1 : 0;
  }
  return range;
}

Value subscript(const Value& object, const Value& index, Meter& meter) {
  if (object.is_unknown() || index.is_unknown()) return Value::unknown();
  if (object.is_dict()) return dict_item(object.as_dict(), index);
  const auto* slice = index.as_object<SliceObject>();
  if (object.is_sequence()) {
    if (slice != nullptr) return sequence_slice(object, *slice, meter);
    const auto items = object.items();
    return items[static_cast<std::size_t>(checked_index(object, index, static_cast<std::int64_t>(items.size())))];
  }
  if (object.is_text()) return slice != nullptr ? text_slice(object.as_text(), *slice) : text_item(object, index);
  if (const auto* array = object.as_object<ArrayObject>()) return array_subscript(*array, index, meter);
  if (const auto* foreign = object.as_object<HostObject>())
    if (auto result = foreign->item(index)) return *result;
  if (const auto* range = object.as_object<RangeObject>()) {
    if (slice == nullptr) return range->at(checked_index(object, index, range->size()));
    const SliceRange part = resolve_slice(*slice, range->size());
    const std::int64_t start = range->at(part.start);
    const std::int64_t step = range->step * part.step;
    return Value(std::shared_ptr<Object>(std::make_shared<RangeObject>(start, start + step * part.count, step)));
  }
  raise(ErrorKind::type, fmt::format("'{}' object is not subscriptable", object.type_name()),
        object.is_callable() ? "call it with (...)" : "");
}

void store_subscript(const Value& object, const Value& index, const Value& value, Meter& meter) {
  if (object.is_unknown() || index.is_unknown()) return;
  if (object.is_dict()) {
    meter.allocate_items(2);
    return object.as_dict().set(index, value);
  }
  if (object.is_list()) {
    std::vector<Value>& items = object.as_list();
    if (const auto* slice = index.as_object<SliceObject>()) return store_slice(items, *slice, value, meter);
    items[static_cast<std::size_t>(
        checked_index(object, index, static_cast<std::int64_t>(items.size()), " assignment"))] = value;
    return;
  }
  if (auto* array = object.as_object<ArrayObject>()) return array_store(*array, index, value, meter);
  if (auto* foreign = object.as_object<HostObject>(); foreign != nullptr && foreign->store_item(index, value)) return;
  raise(ErrorKind::type, fmt::format("'{}' object does not support item assignment", object.type_name()),
        object.is_tuple() ? "use a list where items change" : "");
}

void delete_subscript(const Value& object, const Value& index) {
  if (object.is_unknown() || index.is_unknown()) return;
  if (object.is_dict()) {
    if (object.as_dict().erase(index)) return;
    dict_item(object.as_dict(), index);
  }
  if (auto* foreign = object.as_object<HostObject>(); foreign != nullptr && foreign->delete_item(index)) return;
  if (!object.is_list())
    raise(ErrorKind::type, fmt::format("'{}' object doesn't support item deletion", object.type_name()));
  std::vector<Value>& items = object.as_list();
  const auto* slice = index.as_object<SliceObject>();
  if (slice == nullptr) {
    items.erase(items.begin() + checked_index(object, index, static_cast<std::int64_t>(items.size()), " assignment"));
    return;
  }
  const SliceRange range = resolve_slice(*slice, static_cast<std::int64_t>(items.size()));
  std::vector<bool> dropped(items.size(), false);
  for (std::int64_t i = 0; i < range.count; ++i) dropped[static_cast<std::size_t>(range.start + i * range.step)] = true;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (dropped[i]) continue;
    if (kept != i) items[kept] = std::move(items[i]);
    ++kept;
  }
  items.resize(kept);
}

}  // namespace comma::interpreter
