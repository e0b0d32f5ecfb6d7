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

}  // namespace

Product defi_list_enti(const Call& call, Context&) {
  auto product = std::make_shared<IntegerListConcept>();
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
