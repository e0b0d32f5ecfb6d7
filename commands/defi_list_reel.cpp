#include <cmath>

#include <fmt/format.h>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// A last step shorter or longer than PAS by less than this share of it is rounding of JUSQU_A, not a step (U4.34.01).
constexpr double step_rounding = 1e-3;
// Far more than anything could be computed at; a slip of the pen would fill the memory before that is noticed.
constexpr double most_reals = 1e7;

// Of an interval; the last one may be shorter.
struct Steps {
  int count;
  double length;
};

Steps steps_of(const Keywords& interval, double length, const Context& context) {
  const bool counted = interval.has("NOMBRE");
  const double exact = counted ? static_cast<double>(interval.integer("NOMBRE")) : length / interval.real("PAS");
  if (!(exact <= most_reals)) {
    throw DiagnosticError("out-of-bounds",
                          fmt::format("DEFI_LIST_REEL: {:.4g} steps are more than {:.0e}", exact, most_reals),
                          interval.span_of(counted ? "NOMBRE" : "PAS"), "take fewer or longer steps");
  }
  const double steps = std::round(exact);
  if (steps >= 1.0 && std::abs(exact - steps) <= step_rounding) return {static_cast<int>(steps), length / steps};
  if (exact < 1.0) {
    throw DiagnosticError("wrong-step", "DEFI_LIST_REEL: PAS is longer than the interval", interval.span_of("PAS"),
                          "take a shorter step, or give NOMBRE");
  }
  context.diagnostics.alarm("short-step",
                            fmt::format("DEFI_LIST_REEL: the last step is {:.4g} of PAS", exact - std::floor(exact)),
                            interval.span_of("PAS"), "change PAS or JUSQU_A, or give NOMBRE");
  return {static_cast<int>(std::ceil(exact)), interval.real("PAS")};
}

std::vector<double> by_intervals(const Call& call, const Context& context) {
  std::vector<double> values = {call.real("DEBUT")};
  for (const Keywords& interval : call.factors("INTERVALLE")) {
    const double begin = values.back();
    const double end = interval.real("JUSQU_A");
    if (!(end > begin)) {
      throw DiagnosticError("wrong-order",
                            fmt::format("DEFI_LIST_REEL: JUSQU_A = {} does not lie beyond {}", end, begin),
                            interval.span_of("JUSQU_A"), "values must rise");
    }
    const Steps steps = steps_of(interval, end - begin, context);
    for (int i = 1; i < steps.count; ++i) values.push_back(begin + i * steps.length);
    values.push_back(end);
  }
  return values;
}

}  // namespace

Product defi_list_reel(const Call& call, Context& context) {
  auto product = std::make_shared<ListConcept>();
  product->values = call.has("VALE") ? call.reals("VALE") : by_intervals(call, context);
  for (std::size_t i = 1; i < product->values.size(); ++i) {
    if (product->values[i] > product->values[i - 1]) continue;
    throw DiagnosticError(
        "wrong-order",
        fmt::format("DEFI_LIST_REEL: {} does not lie beyond {}", product->values[i], product->values[i - 1]),
        call.span_of("VALE"), "values must rise");
  }
  return product;
}

}  // namespace comma::commands
