#include "interpreter/values/objects.hpp"

#include <algorithm>

#include "interpreter/syntax/utf8.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/dtype.hpp"
#include "interpreter/values/host_object.hpp"

namespace comma::interpreter {

void release_later(std::shared_ptr<void> held) {
  // Of each thread its own; empty again when the outermost destructor is through.
  thread_local std::vector<std::shared_ptr<void>> pending;
  thread_local bool releasing = false;
  if (!held || held.use_count() > 1) return;
  pending.push_back(std::move(held));
  if (releasing) return;
  releasing = true;
  while (!pending.empty()) {
    const std::shared_ptr<void> last = std::move(pending.back());
    pending.pop_back();
  }
  releasing = false;
}

FunctionObject::~FunctionObject() {
  if (!defaults.empty()) release_later(std::make_shared<std::vector<Value>>(std::move(defaults)));
  release_later(std::move(outer));
}

const Value* CallArguments::find(std::string_view name) const {
  const auto found = std::find_if(named.begin(), named.end(), [&](const Named& item) { return item.name == name; });
  return found == named.end() ? nullptr : &found->value;
}

bool CallArguments::any_unknown() const {
  return open || std::any_of(positional.begin(), positional.end(), [](const Value& v) { return v.is_unknown(); }) ||
         std::any_of(named.begin(), named.end(), [](const Named& item) { return item.value.is_unknown(); });
}

bool CommandObject::equals(const Object& other) const {
  const auto* command = dynamic_cast<const CommandObject*>(&other);
  return command != nullptr && command->name == name;
}

bool TypeObject::equals(const Object& other) const {
  if (const auto* type = dynamic_cast<const DtypeObject*>(&other)) return type->equals(*this);
  const auto* type = dynamic_cast<const TypeObject*>(&other);
  return type != nullptr && type->name == name;
}

std::int64_t RangeObject::size() const {
  // In unsigned arithmetic, since stop - start may exceed 63 bits.
  const auto distance =
      static_cast<std::uint64_t>(step > 0 ? stop : start) - static_cast<std::uint64_t>(step > 0 ? start : stop);
  if (step > 0 ? stop <= start : stop >= start) return 0;
  const auto stride = step > 0 ? static_cast<std::uint64_t>(step) : ~static_cast<std::uint64_t>(step) + 1;
  return static_cast<std::int64_t>((distance - 1) / stride + 1);
}

std::string RangeObject::repr() const {
  std::string text = "range(" + std::to_string(start) + ", " + std::to_string(stop);
  if (step != 1) text += ", " + std::to_string(step);
  return text + ")";
}

bool RangeObject::equals(const Object& other) const {
  const auto* range = dynamic_cast<const RangeObject*>(&other);
  if (range == nullptr || range->size() != size()) return false;
  return size() == 0 || (range->start == start && (size() == 1 || range->step == step));
}

std::vector<Value> DictView::list() const {
  if (kind == Kind::keys) return dict->keys();
  if (kind == Kind::values) return dict->values();
  std::vector<Value> items;
  for (const Dict::Entry& entry : dict->entries()) {
    if (entry.live) items.push_back(Value::tuple({entry.key, entry.value}));
  }
  return items;
}

std::string DictView::type_name() const {
  return kind == Kind::keys ? "dict_keys" : kind == Kind::values ? "dict_values" : "dict_items";
}

bool DictView::equals(const Object& other) const {
  const auto* view = dynamic_cast<const DictView*>(&other);
  if (view == nullptr || view->kind != kind || kind == Kind::values) return this == &other;
  if (view->dict->size() != dict->size()) return false;
  for (const Dict::Entry& entry : dict->entries()) {
    if (!entry.live) continue;
    const Value* match = view->dict->find(entry.key);
    if (match == nullptr || (kind == Kind::items && !equal(*match, entry.value))) return false;
  }
  return true;
}

std::optional<Value> FunctionIterator::next() {
  if (!function) return std::nullopt;
  auto value = function();
  if (!value) function = nullptr;
  return value;
}

Value make_iterator(std::string name, std::function<std::optional<Value>()> next) {
  return Value(std::shared_ptr<Object>(std::make_shared<FunctionIterator>(std::move(name), std::move(next))));
}

namespace {

using Next = std::function<std::optional<Value>()>;

/// Lists and tuples by index, so that a list may grow while it is looped over, as in Python.
Next over_sequence(Value sequence) {
  return [sequence, i = std::size_t{0}]() mutable -> std::optional<Value> {
    const auto items = sequence.items();
    if (i >= items.size()) return std::nullopt;
    return items[i++];
  };
}

Next over_text(Value text) {
  return [text, at = std::size_t{0}]() mutable -> std::optional<Value> {
    const std::string& content = text.as_text();
    if (at >= content.size()) return std::nullopt;
    std::size_t length = 1;
    code_point_at(content, at, length);
    at += length;
    return Value(content.substr(at - length, length));
  };
}

Value item_of(const Dict::Entry& entry, DictView::Kind kind) {
  if (kind == DictView::Kind::keys) return entry.key;
  if (kind == DictView::Kind::values) return entry.value;
  return Value::tuple({entry.key, entry.value});
}

Next over_dict(Value owner, const Dict& dict, DictView::Kind kind) {
  return [owner, &dict, kind, size = dict.size(), i = std::size_t{0}]() mutable -> std::optional<Value> {
    if (dict.size() != size)
      raise(ErrorKind::runtime, "dictionary changed size during iteration", "loop over list(...) of it");
    while (i < dict.entries().size() && !dict.entries()[i].live) ++i;
    if (i >= dict.entries().size()) return std::nullopt;
    return item_of(dict.entries()[i++], kind);
  };
}

Next over_range(Value owner, const RangeObject& range) {
  return [owner, &range, i = std::int64_t{0}, size = range.size()]() mutable -> std::optional<Value> {
    if (i >= size) return std::nullopt;
    return Value(range.at(i++));
  };
}

/// Row by row, as windows: what a loop writes into a row, it writes into the array.
Next over_array(Value owner, const ArrayObject& array) {
  return [owner, &array, i = std::size_t{0}]() mutable -> std::optional<Value> {
    if (i >= array.shape[0]) return std::nullopt;
    return array.row(i++);
  };
}

std::shared_ptr<Iterator> wrap(std::string name, Next next) {
  return std::make_shared<FunctionIterator>(std::move(name), std::move(next));
}

}  // namespace

std::shared_ptr<Iterator> iterate(const Value& value) {
  if (value.is_list()) return wrap("list_iterator", over_sequence(value));
  if (value.is_tuple()) return wrap("tuple_iterator", over_sequence(value));
  if (value.is_text()) return wrap("str_iterator", over_text(value));
  if (value.is_dict()) return wrap("dict_keyiterator", over_dict(value, value.as_dict(), DictView::Kind::keys));
  if (value.is_set()) return wrap("set_iterator", over_dict(value, value.as_set(), DictView::Kind::keys));
  if (const auto* range = value.as_object<RangeObject>()) return wrap("range_iterator", over_range(value, *range));
  if (const auto* view = value.as_object<DictView>())
    return wrap("dict_itemiterator", over_dict(value, *view->dict, view->kind));
  if (const auto* array = value.as_object<ArrayObject>()) return wrap("array_iterator", over_array(value, *array));
  if (const auto* foreign = value.as_object<HostObject>())
    if (const auto items = foreign->iterated()) return wrap("list_iterator", over_sequence(*items));
  if (value.as_object<Iterator>() != nullptr) {
    return std::dynamic_pointer_cast<Iterator>(std::get<std::shared_ptr<Object>>(value.storage()));
  }
  raise(ErrorKind::type, "'" + value.type_name() + "' object is not iterable",
        value.is_integer()   ? "loop over range(...)"
        : value.is_concept() ? "write a tuple, with a comma: (a,)"
                             : "");
}

}  // namespace comma::interpreter
