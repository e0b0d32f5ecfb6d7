// numpy's functions of whole lines of numbers: sums, extremes, orders. Without axis the array is one line.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "interpreter/library/numpy_functions.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter::numpy {

namespace {

using Fold = double (*)(Line);

double sum_in_order(Line line) { return std::accumulate(line.begin(), line.end(), 0.0); }

/// In the order in which numpy adds (its pairwise_sum), so that sums agree to the last digit.
double sum_in_pairs(Line line) {
  constexpr std::size_t longest_block = 128;
  if (line.size() < 8) return sum_in_order(line);
  if (line.size() > longest_block) {
    const std::size_t half = line.size() / 2 - line.size() / 2 % 8;
    return sum_in_pairs(line.first(half)) + sum_in_pairs(line.subspan(half));
  }
  std::array<double, 8> part;
  std::copy_n(line.begin(), 8, part.begin());
  std::size_t i = 8;
  for (; i + 8 <= line.size(); i += 8)
    for (std::size_t k = 0; k < 8; ++k) part[k] += line[i + k];
  double total = ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
  for (; i < line.size(); ++i) total += line[i];
  return total;
}

double product(Line line) { return std::accumulate(line.begin(), line.end(), 1.0, std::multiplies<>()); }

std::size_t place_of_extreme(Line line, bool largest) {
  if (line.empty()) raise(ErrorKind::value, "zero-size array to reduction operation which has no identity");
  std::size_t best = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (std::isnan(line[i])) return i;
    if (largest ? line[i] > line[best] : line[i] < line[best]) best = i;
  }
  return best;
}

double place_of_largest(Line line) { return static_cast<double>(place_of_extreme(line, true)); }
double place_of_smallest(Line line) { return static_cast<double>(place_of_extreme(line, false)); }
double largest(Line line) { return line[place_of_extreme(line, true)]; }
double smallest(Line line) { return line[place_of_extreme(line, false)]; }
double any_set(Line line) {
  return std::ranges::any_of(line, [](double x) { return x != 0.0; }) ? 1.0 : 0.0;
}
double all_set(Line line) {
  return std::ranges::all_of(line, [](double x) { return x != 0.0; }) ? 1.0 : 0.0;
}

double middle(Line line) {
  std::vector<double> sorted(line.begin(), line.end());
  if (sorted.empty() || std::ranges::any_of(sorted, [](double x) { return std::isnan(x); })) return std::nan("");
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2.0;
}

/// One number for each line along the axis, or for the whole array. numpy adds up columns in order, lines in pairs.
Value reduce(const CallArguments& arguments, const Numbers& source, const std::function<double(Line, bool down)>& fold,
             NumberType type) {
  const Value* kept = arguments.find("keepdims");
  const bool keeps = kept != nullptr && truth(*kept);
  const auto axis = axis_argument(arguments, 1, source.shape.size());
  if (!axis) {
    const Shape shape = keeps ? Shape(source.shape.size(), 1) : Shape{};
    return make_value({{fold(source.data, false)}, shape, type});
  }
  const bool down = source.shape.size() == 2 && *axis == 0;
  Numbers result = map_lines(source, *axis, [&](Line line) { return std::vector<double>{fold(line, down)}; });
  result.type = type;
  if (keeps)
    result.shape[*axis] = 1;
  else
    result.shape.erase(result.shape.begin() + static_cast<std::ptrdiff_t>(*axis));
  return make_value(std::move(result));
}

double sum_of(Line line, bool down) { return down ? sum_in_order(line) : sum_in_pairs(line); }

enum class Result { same, at_least_integer, integer, boolean, real };

NumberType result_type(Result result, NumberType source) {
  switch (result) {
    case Result::same:
      return source;
    case Result::at_least_integer:
      return std::max(source, NumberType::integer);
    case Result::integer:
      return NumberType::integer;
    case Result::boolean:
      return NumberType::boolean;
    case Result::real:
      return NumberType::real;
  }
  return source;
}

template <Fold Function, Result Kind>
Value reduction(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("numpy function", arguments, 1, 2, {"axis", "keepdims"});
  const Numbers source = argument(evaluator, arguments[0]);
  return reduce(
      arguments, source, [](Line line, bool) { return Function(line); }, result_type(Kind, source.type));
}

Value array_sum(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("sum", arguments, 1, 2, {"axis", "keepdims"});
  const Numbers source = argument(evaluator, arguments[0]);
  return reduce(arguments, source, sum_of, result_type(Result::at_least_integer, source.type));
}

Value mean(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("mean", arguments, 1, 2, {"axis", "keepdims"});
  const auto fold = [](Line line, bool down) { return sum_of(line, down) / static_cast<double>(line.size()); };
  return reduce(arguments, argument(evaluator, arguments[0]), fold, NumberType::real);
}

double variance(Line line, bool down, double freedom) {
  const double count = static_cast<double>(line.size()), average = sum_of(line, down) / count;
  std::vector<double> squares;
  for (const double x : line) squares.push_back((x - average) * (x - average));
  return sum_of(squares, down) / std::max(count - freedom, 0.0);
}

template <bool Root>
Value deviation(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("std", arguments, 1, 2, {"axis", "ddof", "keepdims"});
  const Value* given = arguments.find("ddof");
  const double freedom = given != nullptr ? real_of(*given) : 0.0;
  const auto fold = [freedom](Line line, bool down) {
    const double square = variance(line, down, freedom);
    return Root ? std::sqrt(square) : square;
  };
  return reduce(arguments, argument(evaluator, arguments[0]), fold, NumberType::real);
}

Value count_nonzero(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("count_nonzero", arguments, 1, 1);
  const Numbers source = argument(evaluator, arguments[0]);
  return static_cast<std::int64_t>(source.data.size()) - std::ranges::count(source.data, 0.0);
}

// Lines that stay lines

/// Along the axis in this position; `fallback` without one, and the flat array where even that is missing or the axis
/// is None.
Value along(Evaluator& evaluator, const CallArguments& arguments, std::size_t position, bool flat_by_default,
            const LineFunction& function, std::optional<NumberType> type = {}) {
  Numbers source = array_argument(evaluator, arguments[0]);
  const bool given = option(arguments, position, "axis") != nullptr;
  const auto wanted = axis_argument(arguments, position, source.shape.size());
  if (!wanted && (given || flat_by_default)) source = flattened(std::move(source));
  const std::size_t axis = wanted ? *wanted : source.shape.size() - 1;
  Numbers result = map_lines(source, axis, function);
  result.type = type.value_or(result.type);
  return make_value(std::move(result));
}

bool before(double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; }

std::vector<double> sorted_line(Line line) {
  std::vector<double> result(line.begin(), line.end());
  std::ranges::stable_sort(result, before);
  return result;
}

std::vector<double> order_of_line(Line line) {
  std::vector<double> order(line.size());
  std::iota(order.begin(), order.end(), 0.0);
  std::ranges::stable_sort(order, [&](double a, double b) {
    return before(line[static_cast<std::size_t>(a)], line[static_cast<std::size_t>(b)]);
  });
  return order;
}

Value sort(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("sort", arguments, 1, 2, {"axis"});
  return along(evaluator, arguments, 1, false, sorted_line);
}

Value argsort(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("argsort", arguments, 1, 2, {"axis"});
  return along(evaluator, arguments, 1, false, order_of_line, NumberType::integer);
}

Value sort_in_place(Evaluator& evaluator, const Value& self, const CallArguments& arguments) {
  const Value sorted = as_method<sort>(evaluator, self, arguments);
  auto& array = *self.as_object<ArrayObject>();
  const Numbers numbers = sorted.as_object<ArrayObject>()->numbers();
  if (numbers.shape != array.shape) raise(ErrorKind::type, "an array is sorted along an axis in place");
  array.write(numbers.data);
  return {};
}

template <bool Products>
Value cumulated(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("cumsum", arguments, 1, 2, {"axis"});
  const auto function = [](Line line) {
    std::vector<double> result(line.begin(), line.end());
    for (std::size_t i = 1; i < result.size(); ++i)
      result[i] = Products ? result[i - 1] * result[i] : result[i - 1] + result[i];
    return result;
  };
  const NumberType type = std::max(argument(evaluator, arguments[0]).type, NumberType::integer);
  return along(evaluator, arguments, 1, true, function, type);
}

Value diff(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("diff", arguments, 1, 3, {"n", "axis"});
  const Value* given = option(arguments, 1, "n");
  const std::int64_t times = given != nullptr ? index_of(*given) : 1;
  if (times < 0) raise(ErrorKind::value, fmt::format("order must be non-negative but got {}", times));
  if (argument(evaluator, arguments[0]).type == NumberType::boolean)
    raise(ErrorKind::not_implemented, "diff of booleans is not supported");
  const auto function = [times](Line line) {
    std::vector<double> result(line.begin(), line.end());
    for (std::int64_t k = 0; k < times && !result.empty(); ++k) {
      for (std::size_t i = 0; i + 1 < result.size(); ++i) result[i] = result[i + 1] - result[i];
      result.pop_back();
    }
    return result;
  };
  return along(evaluator, arguments, 2, false, function);
}

/// Sorted, each number once.
Value unique(Evaluator& evaluator, const CallArguments& arguments) {
  expect_arguments("unique", arguments, 1, 1);
  const Numbers source = argument(evaluator, arguments[0]);
  Numbers result{sorted_line(source.data), {}, source.type};
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  result.data.erase(std::unique(result.data.begin(), result.data.end(), same), result.data.end());
  return make_value(flattened(std::move(result)));
}

constexpr std::array reducing_table = {
    FunctionRow{"sum", array_sum},
    FunctionRow{"prod", reduction<product, Result::at_least_integer>},
    FunctionRow{"mean", mean},
    FunctionRow{"average", mean},
    FunctionRow{"median", reduction<middle, Result::real>},
    FunctionRow{"std", deviation<true>},
    FunctionRow{"var", deviation<false>},
    FunctionRow{"max", reduction<largest, Result::same>},
    FunctionRow{"min", reduction<smallest, Result::same>},
    FunctionRow{"amax", reduction<largest, Result::same>},
    FunctionRow{"amin", reduction<smallest, Result::same>},
    FunctionRow{"argmax", reduction<place_of_largest, Result::integer>},
    FunctionRow{"argmin", reduction<place_of_smallest, Result::integer>},
    FunctionRow{"any", reduction<any_set, Result::boolean>},
    FunctionRow{"all", reduction<all_set, Result::boolean>},
    FunctionRow{"count_nonzero", count_nonzero},
    FunctionRow{"sort", sort},
    FunctionRow{"argsort", argsort},
    FunctionRow{"unique", unique},
    FunctionRow{"cumsum", cumulated<false>},
    FunctionRow{"cumprod", cumulated<true>},
    FunctionRow{"diff", diff},
};

constexpr std::array reducing_method_table = {
    MethodRow{"sum", as_method<array_sum>},
    MethodRow{"prod", as_method<reduction<product, Result::at_least_integer>>},
    MethodRow{"mean", as_method<mean>},
    MethodRow{"std", as_method<deviation<true>>},
    MethodRow{"var", as_method<deviation<false>>},
    MethodRow{"max", as_method<reduction<largest, Result::same>>},
    MethodRow{"min", as_method<reduction<smallest, Result::same>>},
    MethodRow{"argmax", as_method<reduction<place_of_largest, Result::integer>>},
    MethodRow{"argmin", as_method<reduction<place_of_smallest, Result::integer>>},
    MethodRow{"any", as_method<reduction<any_set, Result::boolean>>},
    MethodRow{"all", as_method<reduction<all_set, Result::boolean>>},
    MethodRow{"sort", sort_in_place},
    MethodRow{"argsort", as_method<argsort>},
    MethodRow{"cumsum", as_method<cumulated<false>>},
    MethodRow{"cumprod", as_method<cumulated<true>>},
};

}  // namespace

std::span<const FunctionRow> reducing_functions() { return reducing_table; }
std::span<const MethodRow> reducing_methods() { return reducing_method_table; }

}  // namespace comma::interpreter::numpy
