#include <algorithm>

#include <fmt/format.h>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// Far more than any result has steps; a slip of the pen would fill the memory before that is noticed.
constexpr std::int64_t most_steps = 10'000'000;

std::int64_t step_of(const Keywords& interval, std::int64_t length) {
  const bool counted = interval.has("NOMBRE");
  const std::int64_t divisor = interval.integer(counted ? "NOMBRE" : "PAS");
  const std::int64_t quotient = length / divisor;
  if (quotient * divisor != length) {
    throw DiagnosticError("wrong-step",
                          fmt::format("DEFI_LIST_ENTI: an interval of {} does not divide by {}", length, divisor),
                          interval.span, "change PAS or NOMBRE, or JUSQU_A");
  }
  return counted ? quotient : divisor;
}

void add_interval(const Keywords& interval, std::vector<std::int64_t>& values) {
  const std::int64_t begin = values.back(), end = interval.integer("JUSQU_A");
  if (end <= begin) {
    throw DiagnosticError("wrong-order", fmt::format("DEFI_LIST_ENTI: JUSQU_A = {} does not lie beyond {}", end, begin),
                          interval.span_of("JUSQU_A"), "values must rise");
  }
  const std::int64_t step = step_of(interval, end - begin);
  if ((end - begin) / step > most_steps) {
    throw DiagnosticError("out-of-bounds",
                          fmt::format("DEFI_LIST_ENTI: {} steps are more than {}", (end - begin) / step, most_steps),
                          interval.span, "take longer steps");
  }
  for (std::int64_t value = begin + step; value <= end; value += step) values.push_back(value);
}

// NUME_ORDRE: the storage numbers of the steps of a result whose parameter lies in an interval, ends included.
std::vector<std::int64_t> stored_numbers(const Call& call) {
  const std::string& name = call.text("PARAMETRE");
  std::vector<std::int64_t> numbers;
  for (const solver::ResultStep& step : call.data<ResultConcept>("RESULTAT").result.steps) {
    const auto found = step.parameters.find(name);
    if (name != "INST" && found == step.parameters.end()) continue;
    const double value = name == "INST" ? step.instant : found->second;
    const auto holds = [&](const Keywords& interval) {
      const auto ends = interval.reals("VALE");
      return value >= ends[0] && value <= ends[1];
    };
    if (std::ranges::any_of(call.factors("INTERVALLE"), holds)) numbers.push_back(step.order);
  }
  if (numbers.empty())
    throw DiagnosticError("unknown-step", "DEFI_LIST_ENTI: no step of the result lies in the intervals", call.span,
                          "look at PARAMETRE and INTERVALLE");
  return numbers;
}

}  // namespace

Product defi_list_enti(const Call& call, Context&) {
  auto product = std::make_shared<IntegerListConcept>();
  if (call.text("OPERATION") == "NUME_ORDRE") {
    product->values = stored_numbers(call);
    return product;
  }
  product->values = call.has("VALE") ? call.integers("VALE") : std::vector<std::int64_t>{call.integer("DEBUT")};
  for (const Keywords& interval : call.factors("INTERVALLE")) add_interval(interval, product->values);
  for (std::size_t i = 1; i < product->values.size(); ++i) {
    if (product->values[i] > product->values[i - 1]) continue;
    throw DiagnosticError(
        "wrong-order",
        fmt::format("DEFI_LIST_ENTI: {} does not lie beyond {}", product->values[i], product->values[i - 1]),
        call.span_of("VALE"), "values must rise");
  }
  return product;
}

}  // namespace comma::commands
