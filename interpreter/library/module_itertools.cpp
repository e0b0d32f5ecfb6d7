// itertools: what command files use of it to run through cases.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace itertools {

namespace {

using Pool = std::vector<Value>;
using Places = std::vector<std::size_t>;

/// The items of `pool` at the places, as a tuple; `step` moves the places on and says whether there is a next one.
template <class Step>
Value tuples_of(const char* name, Pool pool, Places places, bool any, Step step) {
  return make_iterator(
      name,
      [pool = std::move(pool), places = std::move(places), any, step, first = true]() mutable -> std::optional<Value> {
        if (!any || (!first && !step(places, pool.size()))) return std::nullopt;
        first = false;
        std::vector<Value> items;
        for (const std::size_t place : places) items.push_back(pool[place]);
        return Value::tuple(std::move(items));
      });
}

std::size_t count_argument(const Value& value, std::string_view name) {
  const std::int64_t count = index_of(value);
  if (count < 0) raise(ErrorKind::value, fmt::format("{} must be non-negative", name));
  return static_cast<std::size_t>(count);
}

Places first_places(std::size_t count, Meter& meter) {
  meter.allocate_items(count);
  Places places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = i;
  return places;
}

/// The last place that can still grow grows; those behind it follow closely.
bool next_combination(Places& places, std::size_t size) {
  const std::size_t count = places.size();
  for (std::size_t i = count; i-- > 0;) {
    if (places[i] == size - count + i) continue;
    ++places[i];
    for (std::size_t j = i + 1; j < count; ++j) places[j] = places[j - 1] + 1;
    return true;
  }
  return false;
}

/// Places in the order of a dictionary, each at most once.
bool next_permutation(Places& places, std::size_t size) {
  std::vector<bool> taken(size, false);
  for (const std::size_t place : places) taken[place] = true;
  for (std::size_t i = places.size(); i-- > 0;) {
    taken[places[i]] = false;
    const auto free_from = [&](std::size_t from) {
      while (from < size && taken[from]) ++from;
      return from;
    };
    const std::size_t larger = free_from(places[i] + 1);
    if (larger == size) continue;
    places[i] = larger;
    taken[larger] = true;
    for (std::size_t j = i + 1; j < places.size(); ++j) {
      places[j] = free_from(0);
      taken[places[j]] = true;
    }
    return true;
  }
  return false;
}

Value combinations(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("combinations", arguments, 2, 2);
  Pool pool = list_of(arguments[0], evaluator.meter());
  const std::size_t count = count_argument(arguments[1], "r");
  const bool any = count <= pool.size();
  return tuples_of("combinations", std::move(pool), any ? first_places(count, evaluator.meter()) : Places(), any,
                   next_combination);
}

Value permutations(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("permutations", arguments, 1, 2);
  Pool pool = list_of(arguments[0], evaluator.meter());
  const std::size_t count =
      arguments.size() > 1 && !arguments[1].is_none() ? count_argument(arguments[1], "r") : pool.size();
  const bool any = count <= pool.size();
  return tuples_of("permutations", std::move(pool), any ? first_places(count, evaluator.meter()) : Places(), any,
                   next_permutation);
}

/// One place a pool, the last running fastest.
Value product(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("product", arguments, 0, arguments.size(), {"repeat"});
  const Value* option = arguments.find("repeat");
  const std::size_t times = option != nullptr ? count_argument(*option, "repeat argument") : 1;
  std::vector<Pool> once;
  for (const Value& source : arguments.positional) once.push_back(list_of(source, evaluator.meter()));
  std::size_t held = 1;
  for (const Pool& pool : once) held += pool.size() + 1;
  evaluator.meter().allocate_items(times > std::numeric_limits<std::uint32_t>::max() ? times : held * times);
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < times; ++i) pools.insert(pools.end(), once.begin(), once.end());
  const bool any = std::none_of(pools.begin(), pools.end(), [](const Pool& pool) { return pool.empty(); });
  Places places(pools.size(), 0);
  return make_iterator(
      "product", [pools = std::move(pools), places = std::move(places), left = any]() mutable -> std::optional<Value> {
        if (!left) return std::nullopt;
        std::vector<Value> items;
        for (std::size_t i = 0; i < pools.size(); ++i) items.push_back(pools[i][places[i]]);
        left = false;
        for (std::size_t i = pools.size(); i-- > 0 && !left;) {
          left = ++places[i] < pools[i].size();
          if (!left) places[i] = 0;
        }
        return Value::tuple(std::move(items));
      });
}

Value chained(std::shared_ptr<Iterator> sources) {
  return make_iterator(
      "chain", [sources = std::move(sources), now = std::shared_ptr<Iterator>()]() mutable -> std::optional<Value> {
        while (true) {
          if (now)
            if (auto value = now->next()) return value;
          auto source = sources->next();
          if (!source) return std::nullopt;
          now = iterate(*source);
        }
      });
}

Value chain(Evaluator&, const CallArguments& arguments) {
  expect_arguments("chain", arguments, 0, arguments.size());
  return chained(iterate(Value::tuple(arguments.positional)));
}

Value zip_longest(Evaluator&, const CallArguments& arguments) {
  expect_arguments("zip_longest", arguments, 0, arguments.size(), {"fillvalue"});
  const Value* option = arguments.find("fillvalue");
  std::vector<std::shared_ptr<Iterator>> sources;
  for (const Value& source : arguments.positional) sources.push_back(iterate(source));
  return make_iterator(
      "zip_longest",
      [sources = std::move(sources), fill = option != nullptr ? *option : Value()]() -> std::optional<Value> {
        std::vector<Value> items;
        bool any = false;
        for (const auto& source : sources) {
          auto value = source->next();
          any = any || value.has_value();
          items.push_back(value ? std::move(*value) : fill);
        }
        return any ? std::optional(Value::tuple(std::move(items))) : std::nullopt;
      });
}

Value count(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("count", arguments, 0, 2, {"start", "step"});
  const auto given = [&](std::size_t place, std::string_view name, int otherwise) {
    if (place < arguments.size()) return arguments[place];
    const Value* option = arguments.find(name);
    return option != nullptr ? *option : Value(otherwise);
  };
  const Value step = given(1, "step", 1);
  for (const Value& number : {given(0, "start", 0), step})
    if (!is_numeric(number)) raise(ErrorKind::type, "a number is required");
  return make_iterator(
      "count", [&meter = evaluator.meter(), next = given(0, "start", 0), step]() mutable -> std::optional<Value> {
        meter.step();
        Value value = next;
        next = binary_operation(Operator::add, next, step, meter);
        return value;
      });
}

Value repeat(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("repeat", arguments, 1, 2, {"times"});
  const Value* times = arguments.size() > 1 ? &arguments[1] : arguments.find("times");
  const bool bounded = times != nullptr;
  return make_iterator("repeat",
                       [&meter = evaluator.meter(), value = arguments[0], bounded,
                        left = bounded ? index_of(*times) : 0]() mutable -> std::optional<Value> {
                         meter.step();
                         if (bounded && left-- <= 0) return std::nullopt;
                         return value;
                       });
}

Value accumulate(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("accumulate", arguments, 1, 2);
  return make_iterator(
      "accumulate",
      [&evaluator, source = iterate(arguments[0]), function = arguments.size() > 1 ? arguments[1] : Value(),
       total = std::optional<Value>()]() mutable -> std::optional<Value> {
        auto value = source->next();
        if (!value) return std::nullopt;
        if (!total)
          total = std::move(value);
        else
          total = function.is_none() ? binary_operation(Operator::add, *total, *value, evaluator.meter())
                                     : evaluator.call(function, CallArguments({*total, *value}));
        return total;
      });
}

/// Draws what it skips from its source too, as Python's does.
Value islice(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("islice", arguments, 2, 4);
  const auto bound = [&](std::size_t place, std::size_t otherwise) {
    return place < arguments.size() && !arguments[place].is_none()
               ? count_argument(arguments[place], "Indices for islice()")
               : otherwise;
  };
  constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();
  const bool only_stop = arguments.size() == 2;
  const std::size_t start = only_stop ? 0 : bound(1, 0), stop = bound(only_stop ? 1 : 2, endless), step = bound(3, 1);
  if (step == 0) raise(ErrorKind::value, "Step for islice() must be a positive integer or None.");
  return make_iterator("islice",
                       [&meter = evaluator.meter(), source = iterate(arguments[0]), wanted = start, stop, step,
                        at = std::size_t{0}]() mutable -> std::optional<Value> {
                         const std::size_t last = std::min(wanted, stop);
                         for (; at < last; ++at) {
                           meter.step();
                           if (!source->next()) return std::nullopt;
                         }
                         if (wanted >= stop) return std::nullopt;
                         wanted = step > stop - wanted ? stop : wanted + step;
                         ++at;
                         return source->next();
                       });
}

constexpr std::array table = {
    FunctionRow{"product", product},
    FunctionRow{"chain", chain},
    FunctionRow{"combinations", combinations},
    FunctionRow{"permutations", permutations},
    FunctionRow{"zip_longest", zip_longest},
    FunctionRow{"count", count},
    FunctionRow{"repeat", repeat},
    FunctionRow{"accumulate", accumulate},
    FunctionRow{"islice", islice},
};

}  // namespace

}  // namespace itertools

Value chain_of(Evaluator&, const CallArguments& arguments) {
  expect_arguments("from_iterable", arguments, 1, 1);
  return itertools::chained(iterate(arguments[0]));
}

std::span<const FunctionRow> itertools_functions() { return itertools::table; }

}  // namespace comma::interpreter
