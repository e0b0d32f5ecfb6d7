// The methods of list, tuple, dict and set.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

// list

Value append(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("append", arguments, 1, 1);
  auto& items = self.as_list();
  if (items.size() == items.capacity()) evaluator.meter().allocate_items(items.size() + 1);
  items.push_back(arguments[0]);
  return {};
}

Value extend(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("extend", arguments, 1, 1);
  if (arguments[0].is_unknown()) return arguments[0];
  augmented_operation(Operator::add, self, arguments[0], evaluator.meter());
  return {};
}

Value insert(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("insert", arguments, 2, 2);
  auto& items = self.as_list();
  evaluator.meter().allocate_items(items.size() + 1);
  const auto size = static_cast<std::int64_t>(items.size());
  std::int64_t place = index_of(arguments[0]);
  if (place < 0) place = std::max<std::int64_t>(0, place + size);
  items.insert(items.begin() + std::min(place, size), arguments[1]);
  return {};
}

Value list_pop(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("pop", arguments, 0, 1);
  auto& items = self.as_list();
  if (items.empty()) raise(ErrorKind::index, "pop from empty list");
  const auto size = static_cast<std::int64_t>(items.size());
  std::int64_t place = arguments.size() > 0 ? index_of(arguments[0]) : size - 1;
  if (place < 0) place += size;
  if (place < 0 || place >= size) raise(ErrorKind::index, "pop index out of range");
  Value value = std::move(items[static_cast<std::size_t>(place)]);
  items.erase(items.begin() + place);
  return value;
}

Value list_remove(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("remove", arguments, 1, 1);
  auto& items = self.as_list();
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Value& item) { return equal(item, arguments[0]); });
  if (found == items.end()) raise(ErrorKind::value, "list.remove(x): x not in list");
  items.erase(found);
  return {};
}

Value list_clear(Evaluator&, const Value& self, const CallArguments&) {
  self.as_list().clear();
  return {};
}

Value list_copy(Evaluator& evaluator, const Value& self, const CallArguments&) {
  return Value::list(list_of(self, evaluator.meter()));
}

Value reverse(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("reverse", arguments, 0, 0);
  std::reverse(self.as_list().begin(), self.as_list().end());
  return {};
}

Value sort(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("sort", arguments, 0, 0, {"key", "reverse"});
  std::vector<Value> items = self.as_list();  // a key function may look at the list
  sort_values(evaluator, items, arguments);
  self.as_list() = std::move(items);
  return {};
}

Value sequence_index(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("index", arguments, 1, 3);
  const std::vector<Value> items = list_of(self, evaluator.meter());
  SliceObject slice;
  if (arguments.size() > 1) slice.start = arguments[1];
  if (arguments.size() > 2) slice.stop = arguments[2];
  const SliceRange range = resolve_slice(slice, static_cast<std::int64_t>(items.size()));
  for (std::int64_t i = range.start; i < range.start + range.count; ++i) {
    if (equal(items[static_cast<std::size_t>(i)], arguments[0])) return i;
  }
  raise(ErrorKind::value, self.is_tuple() ? "tuple.index(x): x not in tuple"
                                          : fmt::format("{} is not in {}", arguments[0].repr(), self.type_name()));
}

Value sequence_count(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("count", arguments, 1, 1);
  const std::vector<Value> items = list_of(self, evaluator.meter());
  return static_cast<std::int64_t>(
      std::count_if(items.begin(), items.end(), [&](const Value& item) { return equal(item, arguments[0]); }));
}

// dict

std::shared_ptr<Dict> shared_dict(const Value& self) { return std::get<std::shared_ptr<Dict>>(self.storage()); }

Value view(const Value& self, DictView::Kind kind) {
  return Value(std::shared_ptr<Object>(std::make_shared<DictView>(shared_dict(self), kind)));
}

Value keys(Evaluator&, const Value& self, const CallArguments&) { return view(self, DictView::Kind::keys); }
Value values(Evaluator&, const Value& self, const CallArguments&) { return view(self, DictView::Kind::values); }
Value items(Evaluator&, const Value& self, const CallArguments&) { return view(self, DictView::Kind::items); }

Value get(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("get", arguments, 1, 2);
  const Value* value = self.as_dict().find(arguments[0]);
  if (value != nullptr) return *value;
  return arguments.size() > 1 ? arguments[1] : Value();
}

Value dict_pop(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("pop", arguments, 1, 2);
  if (const Value* found = self.as_dict().find(arguments[0])) {
    Value value = *found;
    self.as_dict().erase(arguments[0]);
    return value;
  }
  if (arguments.size() > 1) return arguments[1];
  auto error = make_exception(ErrorKind::key, "");
  error->arguments = {arguments[0]};
  throw RaisedError(std::move(error));
}

Value popitem(Evaluator&, const Value& self, const CallArguments&) {
  const auto names = self.as_dict().keys();
  if (names.empty()) raise(ErrorKind::key, "popitem(): dictionary is empty");
  Value pair = Value::tuple({names.back(), *self.as_dict().find(names.back())});
  self.as_dict().erase(names.back());
  return pair;
}

Value setdefault(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("setdefault", arguments, 1, 2);
  if (const Value* found = self.as_dict().find(arguments[0])) return *found;
  const Value fallback = arguments.size() > 1 ? arguments[1] : Value();
  self.as_dict().set(arguments[0], fallback);
  return fallback;
}

Value dict_update(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  if (arguments.any_unknown()) return Value::unknown();
  const Value more = construct(evaluator, "dict", arguments);
  self.as_dict().update(more.as_dict());
  return {};
}

Value dict_clear(Evaluator&, const Value& self, const CallArguments&) {
  self.as_dict().clear();
  return {};
}

Value dict_copy(Evaluator& evaluator, const Value& self, const CallArguments&) {
  return construct(evaluator, "dict", CallArguments({self}));
}

Value fromkeys(Evaluator& evaluator, const Value&, const CallArguments& arguments) {
  expect_arguments("fromkeys", arguments, 1, 2);
  auto dict = std::make_shared<Dict>();
  for (const Value& key : list_of(arguments[0], evaluator.meter()))
    dict->set(key, arguments.size() > 1 ? arguments[1] : Value());
  return Value(std::move(dict));
}

// set

void expect_mutable(const Value& self, std::string_view name) {
  if (self.type_name() == "frozenset")
    raise(ErrorKind::attribute, fmt::format("'frozenset' object has no attribute '{}'", name));
}

Value add(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("add", arguments, 1, 1);
  expect_mutable(self, "add");
  self.as_set().set(arguments[0], Value());
  return {};
}

Value discard(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("discard", arguments, 1, 1);
  expect_mutable(self, "discard");
  self.as_set().erase(arguments[0]);
  return {};
}

Value set_remove(Evaluator&, const Value& self, const CallArguments& arguments) {
  expect_arguments("remove", arguments, 1, 1);
  expect_mutable(self, "remove");
  if (self.as_set().erase(arguments[0])) return {};
  auto error = make_exception(ErrorKind::key, "");
  error->arguments = {arguments[0]};
  throw RaisedError(std::move(error));
}

Value set_pop(Evaluator&, const Value& self, const CallArguments&) {
  expect_mutable(self, "pop");
  const auto names = self.as_set().keys();
  if (names.empty()) raise(ErrorKind::key, "pop from an empty set");
  self.as_set().erase(names.front());
  return names.front();
}

Value set_clear(Evaluator&, const Value& self, const CallArguments&) {
  expect_mutable(self, "clear");
  self.as_set().clear();
  return {};
}

Value set_copy(Evaluator&, const Value& self, const CallArguments&) {
  return make_set(self.as_set().keys(), self.type_name() == "frozenset");
}

Value set_update(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_mutable(self, "update");
  if (arguments.any_unknown()) return Value::unknown();
  for (const Value& source : arguments.positional) {
    for (const Value& key : list_of(source, evaluator.meter())) self.as_set().set(key, Value());
  }
  return {};
}

Value combine(Evaluator& evaluator, const Value& self, const CallArguments& arguments, Operator op) {
  if (arguments.any_unknown()) return Value::unknown();
  Value result = make_set(self.as_set().keys(), self.type_name() == "frozenset");
  for (const Value& source : arguments.positional) {
    result = binary_operation(op, result, make_set(list_of(source, evaluator.meter())), evaluator.meter());
  }
  return result;
}

Value set_union(Evaluator& e, const Value& self, const CallArguments& a) {
  return combine(e, self, a, Operator::bit_or);
}
Value set_intersection(Evaluator& e, const Value& self, const CallArguments& a) {
  return combine(e, self, a, Operator::bit_and);
}
Value set_difference(Evaluator& e, const Value& self, const CallArguments& a) {
  return combine(e, self, a, Operator::subtract);
}
Value set_symmetric(Evaluator& e, const Value& self, const CallArguments& a) {
  return combine(e, self, a, Operator::bit_xor);
}

Value relation(Evaluator& evaluator, const Value& self, const CallArguments& arguments, std::string_view name,
               Operator op) {
  expect_arguments(name, arguments, 1, 1);
  return compare(op, self, make_set(list_of(arguments[0], evaluator.meter())));
}

Value issubset(Evaluator& e, const Value& self, const CallArguments& a) {
  return relation(e, self, a, "issubset", Operator::less_equal);
}
Value issuperset(Evaluator& e, const Value& self, const CallArguments& a) {
  return relation(e, self, a, "issuperset", Operator::greater_equal);
}

Value isdisjoint(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  expect_arguments("isdisjoint", arguments, 1, 1);
  const std::vector<Value> other = list_of(arguments[0], evaluator.meter());
  return std::none_of(other.begin(), other.end(), [&](const Value& key) { return self.as_set().find(key) != nullptr; });
}

constexpr std::array of_lists = {
    MethodRow{"append", append},        MethodRow{"extend", extend},        MethodRow{"insert", insert},
    MethodRow{"pop", list_pop},         MethodRow{"remove", list_remove},   MethodRow{"clear", list_clear},
    MethodRow{"copy", list_copy},       MethodRow{"reverse", reverse},      MethodRow{"sort", sort},
    MethodRow{"index", sequence_index}, MethodRow{"count", sequence_count},
};
constexpr std::array of_tuples = {MethodRow{"index", sequence_index}, MethodRow{"count", sequence_count}};
constexpr std::array of_dicts = {
    MethodRow{"keys", keys},
    MethodRow{"values", values},
    MethodRow{"items", items},
    MethodRow{"get", get},
    MethodRow{"pop", dict_pop},
    MethodRow{"popitem", popitem},
    MethodRow{"setdefault", setdefault},
    MethodRow{"update", dict_update},
    MethodRow{"clear", dict_clear},
    MethodRow{"copy", dict_copy},
    MethodRow{"fromkeys", fromkeys},
};
constexpr std::array of_sets = {
    MethodRow{"add", add},
    MethodRow{"discard", discard},
    MethodRow{"remove", set_remove},
    MethodRow{"pop", set_pop},
    MethodRow{"clear", set_clear},
    MethodRow{"copy", set_copy},
    MethodRow{"update", set_update},
    MethodRow{"union", set_union},
    MethodRow{"intersection", set_intersection},
    MethodRow{"difference", set_difference},
    MethodRow{"symmetric_difference", set_symmetric},
    MethodRow{"issubset", issubset},
    MethodRow{"issuperset", issuperset},
    MethodRow{"isdisjoint", isdisjoint},
};

}  // namespace

std::span<const MethodRow> list_methods() { return of_lists; }
std::span<const MethodRow> tuple_methods() { return of_tuples; }
std::span<const MethodRow> dict_methods() { return of_dicts; }
std::span<const MethodRow> set_methods() { return of_sets; }

}  // namespace comma::interpreter
