// Of functools, operator and collections what is a line or two.
#include <algorithm>
#include <array>

#include "interpreter/library/builtins.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace collections {

namespace {

// functools

Value reduce(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("reduce", arguments, 2, 3);
  const auto source = iterate(arguments[1]);
  std::optional<Value> total = arguments.size() > 2 ? std::optional(arguments[2]) : source->next();
  if (!total) raise(ErrorKind::type, "reduce() of empty iterable with no initial value");
  while (auto value = source->next()) {
    evaluator.meter().step();
    total = evaluator.call(arguments[0], CallArguments({*total, *value}));
  }
  return *total;
}

// operator

template <Operator op>
Value binary(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments(symbol_of(op), arguments, 2, 2);
  return binary_operation(op, arguments[0], arguments[1], evaluator.meter());
}

template <Operator op>
Value comparison(Evaluator&, const CallArguments& arguments) {
  expect_arguments(symbol_of(op), arguments, 2, 2);
  return compare(op, arguments[0], arguments[1]);
}

Value negative(Evaluator&, const CallArguments& arguments) {
  expect_arguments("neg", arguments, 1, 1);
  return unary_operation(Operator::minus, arguments[0]);
}

/// itemgetter(i): x -> x[i]; of several: x -> (x[i], x[j]).
Value item_getter(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("itemgetter", arguments, 1, std::max<std::size_t>(arguments.size(), 1));
  const auto code = [&meter = evaluator.meter(), wanted = arguments.positional](const std::vector<Value>& given) {
    if (given.size() != 1)
      raise(ErrorKind::type, "itemgetter expected 1 argument, got " + std::to_string(given.size()));
    std::vector<Value> items;
    for (const Value& index : wanted) items.push_back(subscript(given[0], index, meter));
    return items.size() == 1 ? items[0] : Value::tuple(std::move(items));
  };
  return Value(std::shared_ptr<Object>(std::make_shared<HostFunction>("itemgetter", code)));
}

// collections

/// defaultdict(factory, further as of dict).
Value default_dict(Evaluator& evaluator, const CallArguments& arguments) {
  CallArguments rest = arguments;
  if (!rest.positional.empty()) rest.positional.erase(rest.positional.begin());
  const Value made = construct(evaluator, "dict", rest);
  if (arguments.size() == 0 || arguments[0].is_none()) return made;
  if (!arguments[0].is_callable()) raise(ErrorKind::type, "first argument must be callable or None");
  made.as_dict().factory = std::make_shared<const Value>(arguments[0]);
  return made;
}

constexpr std::array functools_table = {FunctionRow{"reduce", reduce}};
constexpr std::array operator_table = {
    FunctionRow{"itemgetter", item_getter},
    FunctionRow{"add", binary<Operator::add>},
    FunctionRow{"sub", binary<Operator::subtract>},
    FunctionRow{"mul", binary<Operator::multiply>},
    FunctionRow{"truediv", binary<Operator::divide>},
    FunctionRow{"floordiv", binary<Operator::floor_divide>},
    FunctionRow{"mod", binary<Operator::modulo>},
    FunctionRow{"pow", binary<Operator::power>},
    FunctionRow{"neg", negative},
    FunctionRow{"eq", comparison<Operator::equal>},
    FunctionRow{"ne", comparison<Operator::not_equal>},
    FunctionRow{"lt", comparison<Operator::less>},
    FunctionRow{"le", comparison<Operator::less_equal>},
    FunctionRow{"gt", comparison<Operator::greater>},
    FunctionRow{"ge", comparison<Operator::greater_equal>},
};
constexpr std::array collections_table = {FunctionRow{"defaultdict", default_dict}};

}  // namespace

}  // namespace collections

std::span<const FunctionRow> functools_functions() { return collections::functools_table; }
std::span<const FunctionRow> operator_functions() { return collections::operator_table; }
std::span<const FunctionRow> collections_functions() { return collections::collections_table; }

}  // namespace comma::interpreter
