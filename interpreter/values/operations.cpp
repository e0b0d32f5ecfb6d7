#include "interpreter/values/operations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/format.hpp"
#include "interpreter/values/host_object.hpp"

namespace comma::interpreter {

Value number_operation(Operator op, const Value& a, const Value& b, Meter& meter);

namespace {

Value repeat_text(const std::string& text, std::int64_t times, Meter& meter) {
  if (times <= 0 || text.empty()) return "";
  meter.allocate(static_cast<std::uint64_t>(times) > (1ULL << 40) / text.size()
                     ? 1ULL << 40
                     : text.size() * static_cast<std::uint64_t>(times));
  std::string out;
  out.reserve(text.size() * static_cast<std::size_t>(times));
  for (std::int64_t i = 0; i < times; ++i) out += text;
  return out;
}

std::vector<Value> repeat_items(std::span<const Value> items, std::int64_t times, Meter& meter) {
  std::vector<Value> out;
  if (times <= 0 || items.empty()) return out;
  meter.allocate_items(static_cast<std::uint64_t>(times) > (1ULL << 40) / items.size()
                           ? 1ULL << 40
                           : items.size() * static_cast<std::uint64_t>(times));
  out.reserve(items.size() * static_cast<std::size_t>(times));
  for (std::int64_t i = 0; i < times; ++i) out.insert(out.end(), items.begin(), items.end());
  return out;
}

std::vector<Value> concatenate(std::span<const Value> a, std::span<const Value> b, Meter& meter) {
  meter.allocate_items(a.size() + b.size());
  std::vector<Value> out(a.begin(), a.end());
  out.insert(out.end(), b.begin(), b.end());
  return out;
}

std::optional<Value> add_sequences(const Value& a, const Value& b, Meter& meter) {
  if (a.is_text()) {
    if (!b.is_text()) {
      raise(ErrorKind::type, fmt::format("can only concatenate str (not \"{}\") to str", b.type_name()),
            "convert it with str(...)");
    }
    meter.allocate(a.as_text().size() + b.as_text().size());
    return Value(a.as_text() + b.as_text());
  }
  if (!a.is_sequence()) return std::nullopt;
  if (a.is_list() != b.is_list() || !b.is_sequence()) {
    raise(ErrorKind::type, fmt::format("can only concatenate {0} (not \"{1}\") to {0}", a.type_name(), b.type_name()),
          a.is_list() ? "write [x] for a list of one item" : "write (x,) for a tuple of one item");
  }
  auto items = concatenate(a.items(), b.items(), meter);
  return a.is_list() ? Value::list(std::move(items)) : Value::tuple(std::move(items));
}

std::optional<Value> multiply_sequence(const Value& sequence, const Value& count, Meter& meter) {
  if (!sequence.is_text() && !sequence.is_sequence()) return std::nullopt;
  if (!count.is_bool() && !count.is_integer() && !count.is_big_integer()) {
    raise(ErrorKind::type, "can't multiply sequence by non-int of type '" + count.type_name() + "'");
  }
  const std::int64_t times =
      count.is_big_integer() ? (count.as_big_integer().is_negative() ? 0 : std::int64_t{1} << 40) : index_of(count);
  if (sequence.is_text()) return repeat_text(sequence.as_text(), times, meter);
  auto items = repeat_items(sequence.items(), times, meter);
  return sequence.is_list() ? Value::list(std::move(items)) : Value::tuple(std::move(items));
}

Value set_operation(Operator op, const Dict& a, const Dict& b, bool frozen) {
  auto result = std::make_shared<Set>();
  result->keys = std::make_unique<Dict>();
  result->frozen = frozen;
  for (const Value& key : a.keys()) {
    const bool shared = b.find(key) != nullptr;
    const bool kept = op == Operator::bit_or || (op == Operator::bit_and ? shared : !shared);
    if (kept) result->keys->set(key, Value());
  }
  if (op == Operator::bit_or || op == Operator::bit_xor) {
    for (const Value& key : b.keys()) {
      if (op == Operator::bit_or || a.find(key) == nullptr) result->keys->set(key, Value());
    }
  }
  return Value(std::move(result));
}

bool is_set_operator(Operator op) {
  return op == Operator::bit_or || op == Operator::bit_and || op == Operator::bit_xor || op == Operator::subtract;
}

Value merge_dicts(const Dict& a, const Dict& b) {
  auto result = std::make_shared<Dict>();
  result->update(a);
  result->update(b);
  return Value(std::move(result));
}

}  // namespace

Value binary_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  if (a.is_unknown() || b.is_unknown()) return Value::unknown();
  if (is_numeric(a) && is_numeric(b)) return number_operation(op, a, b, meter);
  const auto is_unknown = [](const Value& value) { return value.is_unknown(); };
  if (a.is_text() && b.is_tuple() && std::any_of(b.items().begin(), b.items().end(), is_unknown))
    return Value::unknown();
  if (a.is_text() && op == Operator::modulo) return Value(format_percent(a.as_text(), b, meter));
  if (a.as_object<ArrayObject>() != nullptr || b.as_object<ArrayObject>() != nullptr)
    return array_operation(op, a, b, meter);
  if (const auto* foreign = a.as_object<HostObject>())
    if (auto result = foreign->combined(op, b)) return *result;
  if (op == Operator::add) {
    if (auto result = add_sequences(a, b, meter)) return *result;
  }
  if (op == Operator::multiply) {
    if (auto result = multiply_sequence(a, b, meter)) return *result;
    if (auto result = multiply_sequence(b, a, meter)) return *result;
  }
  if (a.is_set() && b.is_set() && is_set_operator(op)) {
    return set_operation(op, a.as_set(), b.as_set(), a.type_name() == "frozenset");
  }
  if (a.is_dict() && b.is_dict() && op == Operator::bit_or) return merge_dicts(a.as_dict(), b.as_dict());
  return number_operation(op, a, b, meter);
}

Value augmented_operation(Operator op, const Value& a, const Value& b, Meter& meter) {
  if (a.is_list() && op == Operator::add && !b.is_unknown()) {
    std::vector<Value> more = list_of(b, meter);
    std::vector<Value>& items = a.as_list();
    meter.allocate_items(more.size());
    items.insert(items.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    return a;
  }
  if (a.is_dict() && b.is_dict() && op == Operator::bit_or) {
    a.as_dict().update(b.as_dict());
    return a;
  }
  if (a.is_set() && b.is_set() && op == Operator::bit_or) {
    for (const Value& key : b.as_set().keys()) a.as_set().set(key, Value());
    return a;
  }
  if (auto* array = a.as_object<ArrayObject>(); array != nullptr && !b.is_unknown()) {
    array_update(op, *array, b, meter);
    return a;
  }
  return binary_operation(op, a, b, meter);
}

std::optional<std::int64_t> length_of(const Value& value) {
  if (value.is_text()) return static_cast<std::int64_t>(count_code_points(value.as_text()));
  if (value.is_sequence()) return static_cast<std::int64_t>(value.items().size());
  if (value.is_dict()) return static_cast<std::int64_t>(value.as_dict().size());
  if (value.is_set()) return static_cast<std::int64_t>(value.as_set().size());
  if (const auto* range = value.as_object<RangeObject>()) return range->size();
  if (const auto* view = value.as_object<DictView>()) return static_cast<std::int64_t>(view->dict->size());
  if (const auto* array = value.as_object<ArrayObject>()) return static_cast<std::int64_t>(array->shape[0]);
  if (const auto* foreign = value.as_object<HostObject>()) return foreign->length();
  return std::nullopt;
}

std::vector<Value> list_of(const Value& iterable, Meter& meter) {
  if (iterable.is_sequence()) return {iterable.items().begin(), iterable.items().end()};
  std::vector<Value> items;
  const auto iterator = iterate(iterable);
  while (auto item = iterator->next()) {
    meter.step();
    if (items.size() == items.capacity()) meter.allocate_items(items.size() + 1);
    items.push_back(std::move(*item));
  }
  return items;
}

}  // namespace comma::interpreter
