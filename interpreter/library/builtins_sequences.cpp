// Builtins that loop: range, zip, map, sum, sorted ...
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

Value enumerate(Evaluator&, const CallArguments& arguments) {
  expect_arguments("enumerate", arguments, 1, 2, {"start"});
  const Value* start = arguments.size() > 1 ? &arguments[1] : arguments.find("start");
  const std::int64_t first = start != nullptr ? index_of(*start) : 0;
  return make_iterator("enumerate", [iterator = iterate(arguments[0]), i = first]() mutable -> std::optional<Value> {
    auto value = iterator->next();
    if (!value) return std::nullopt;
    return Value::tuple({Value(i++), std::move(*value)});
  });
}

std::vector<std::shared_ptr<Iterator>> iterators_of(const CallArguments& arguments, std::size_t from) {
  std::vector<std::shared_ptr<Iterator>> iterators;
  for (std::size_t i = from; i < arguments.size(); ++i) iterators.push_back(iterate(arguments[i]));
  return iterators;
}

Value zip(Evaluator&, const CallArguments& arguments) {
  expect_arguments("zip", arguments, 0, arguments.size(), {"strict"});
  const Value* option = arguments.find("strict");
  const bool strict = option != nullptr && truth(*option);
  return make_iterator("zip", [iterators = iterators_of(arguments, 0), strict]() -> std::optional<Value> {
    if (iterators.empty()) return std::nullopt;
    std::vector<Value> items;
    for (const auto& iterator : iterators) {
      auto value = iterator->next();
      if (value) {
        items.push_back(std::move(*value));
        continue;
      }
      if (strict && !items.empty())
        raise(ErrorKind::value, fmt::format("zip() argument {} is shorter than argument 1", items.size() + 1));
      if (strict && std::any_of(iterators.begin() + 1, iterators.end(),
                                [](const auto& other) { return other->next().has_value(); })) {
        raise(ErrorKind::value, "zip() argument 2 is longer than argument 1");
      }
      return std::nullopt;
    }
    return Value::tuple(std::move(items));
  });
}

Value map(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("map", arguments, 2, std::max<std::size_t>(arguments.size(), 2));
  return make_iterator(
      "map", [&evaluator, function = arguments[0], iterators = iterators_of(arguments, 1)]() -> std::optional<Value> {
        CallArguments call;
        for (const auto& iterator : iterators) {
          auto value = iterator->next();
          if (!value) return std::nullopt;
          call.positional.push_back(std::move(*value));
        }
        return evaluator.call(function, call);
      });
}

Value filter(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("filter", arguments, 2, 2);
  return make_iterator(
      "filter", [&evaluator, function = arguments[0], iterator = iterate(arguments[1])]() -> std::optional<Value> {
        while (auto value = iterator->next()) {
          const Value passes = function.is_none() ? *value : evaluator.call(function, CallArguments({*value}));
          if (passes.is_unknown() || truth(passes)) return value;
        }
        return std::nullopt;
      });
}

Value reversed(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("reversed", arguments, 1, 1);
  const Value& source = arguments[0];
  if (!source.is_sequence() && !source.is_text() && !source.is_dict() && source.as_object<RangeObject>() == nullptr &&
      source.as_object<ArrayObject>() == nullptr) {
    raise(ErrorKind::type, fmt::format("'{}' object is not reversible", source.type_name()));
  }
  std::vector<Value> items = list_of(source, evaluator.meter());
  std::reverse(items.begin(), items.end());
  return make_iterator("list_reverseiterator",
                       [items = std::move(items), i = std::size_t{0}]() mutable -> std::optional<Value> {
                         if (i >= items.size()) return std::nullopt;
                         return items[i++];
                       });
}

Value sorted(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("sorted", arguments, 1, 1, {"key", "reverse"});
  std::vector<Value> items = list_of(arguments[0], evaluator.meter());
  sort_values(evaluator, items, arguments);
  return Value::list(std::move(items));
}

Value sum(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("sum", arguments, 1, 2, {"start"});
  const Value* start = arguments.size() > 1 ? &arguments[1] : arguments.find("start");
  Value total = start != nullptr ? *start : Value(0);
  if (total.is_text()) raise(ErrorKind::type, "sum() can't sum strings [use ''.join(seq) instead]");
  const auto iterator = iterate(arguments[0]);
  while (auto value = iterator->next()) {
    evaluator.meter().step();
    total = binary_operation(Operator::add, total, *value, evaluator.meter());
  }
  return total;
}

Value extreme(Evaluator& evaluator, const CallArguments& arguments, std::string_view name, bool largest) {
  if (arguments.size() == 0) raise(ErrorKind::type, fmt::format("{} expected at least 1 argument, got 0", name));
  expect_arguments(name, arguments, 1, arguments.size(), {"key", "default"});
  const std::vector<Value> items =
      arguments.size() == 1 ? list_of(arguments[0], evaluator.meter()) : arguments.positional;
  if (items.empty()) {
    if (const Value* fallback = arguments.find("default")) return *fallback;
    raise(ErrorKind::value, fmt::format("{}() arg is an empty sequence", name), "give default=...");
  }
  const Value* key = arguments.find("key");
  const auto key_of = [&](const Value& item) {
    return key == nullptr || key->is_none() ? item : evaluator.call(*key, CallArguments({item}));
  };
  Value best = items[0];
  Value best_key = key_of(best);
  for (std::size_t i = 1; i < items.size(); ++i) {
    evaluator.meter().step();
    Value own_key = key_of(items[i]);
    const Value better = compare(largest ? Operator::greater : Operator::less, own_key, best_key);
    if (better.is_unknown()) return better;
    if (!truth(better)) continue;
    best = items[i];
    best_key = std::move(own_key);
  }
  return best_key.is_unknown() ? best_key : best;
}

Value min(Evaluator& evaluator, const CallArguments& arguments) { return extreme(evaluator, arguments, "min", false); }
Value max(Evaluator& evaluator, const CallArguments& arguments) { return extreme(evaluator, arguments, "max", true); }

Value quantify(Evaluator& evaluator, const CallArguments& arguments, std::string_view name, bool wanted) {
  expect_arguments(name, arguments, 1, 1);
  const auto iterator = iterate(arguments[0]);
  while (auto value = iterator->next()) {
    evaluator.meter().step();
    if (value->is_unknown()) return *value;
    if (truth(*value) == wanted) return wanted;
  }
  return !wanted;
}

Value any(Evaluator& evaluator, const CallArguments& arguments) { return quantify(evaluator, arguments, "any", true); }
Value all(Evaluator& evaluator, const CallArguments& arguments) { return quantify(evaluator, arguments, "all", false); }

Value iter(Evaluator&, const CallArguments& arguments) {
  expect_arguments("iter", arguments, 1, 1);
  return Value(std::shared_ptr<Object>(iterate(arguments[0])));
}

Value next(Evaluator&, const CallArguments& arguments) {
  expect_arguments("next", arguments, 1, 2);
  auto* iterator = arguments[0].as_object<Iterator>();
  if (iterator == nullptr)
    raise(ErrorKind::type, fmt::format("'{}' object is not an iterator", arguments[0].type_name()),
          "make one with iter(...)");
  if (auto value = iterator->next()) return *value;
  if (arguments.size() > 1) return arguments[1];
  auto error = make_exception(ErrorKind::stop_iteration, "");
  error->arguments.clear();
  throw RaisedError(std::move(error));
}

constexpr std::array sequence_table = {
    FunctionRow{"enumerate", enumerate},
    FunctionRow{"zip", zip},
    FunctionRow{"map", map},
    FunctionRow{"filter", filter},
    FunctionRow{"reversed", reversed},
    FunctionRow{"sorted", sorted},
    FunctionRow{"sum", sum},
    FunctionRow{"min", min},
    FunctionRow{"max", max},
    FunctionRow{"any", any},
    FunctionRow{"all", all},
    FunctionRow{"iter", iter},
    FunctionRow{"next", next},
};

}  // namespace

std::span<const FunctionRow> sequence_functions() { return sequence_table; }

Value make_set(const std::vector<Value>& items, bool frozen) {
  auto set = std::make_shared<Set>();
  set->keys = std::make_unique<Dict>();
  set->frozen = frozen;
  for (const Value& item : items) set->keys->set(item, Value());
  return Value(std::move(set));
}

/// Merge sort: stable, and safe with a comparison that is no strict order (nan, sets) or that raises.
void sort_values(Evaluator& evaluator, std::vector<Value>& items, const CallArguments& arguments) {
  const Value* key = arguments.find("key");
  const Value* option = arguments.find("reverse");
  const bool reverse = option != nullptr && truth(*option);
  struct Keyed {
    Value key, item;
  };
  std::vector<Keyed> rows;
  rows.reserve(items.size());
  for (const Value& item : items) {
    rows.push_back({key == nullptr || key->is_none() ? item : evaluator.call(*key, CallArguments({item})), item});
  }
  // Reversing before and after keeps equal items in their order, as Python does.
  if (reverse) std::reverse(rows.begin(), rows.end());
  std::vector<Keyed> other(rows.size());
  for (std::size_t width = 1; width < rows.size(); width *= 2) {
    for (std::size_t begin = 0; begin < rows.size(); begin += 2 * width) {
      const std::size_t middle = std::min(begin + width, rows.size());
      const std::size_t end = std::min(begin + 2 * width, rows.size());
      std::size_t left = begin, right = middle;
      for (std::size_t out = begin; out < end; ++out) {
        evaluator.meter().step();
        const bool take_right = left >= middle || (right < end && less_than(rows[right].key, rows[left].key));
        other[out] = std::move(take_right ? rows[right++] : rows[left++]);
      }
    }
    rows.swap(other);
  }
  if (reverse) std::reverse(rows.begin(), rows.end());
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = std::move(rows[i].item);
}

}  // namespace comma::interpreter
