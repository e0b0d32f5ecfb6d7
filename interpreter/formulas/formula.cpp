#include "interpreter/formulas/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "interpreter/library/builtins.hpp"

namespace comma::interpreter {

Formula::Formula(std::string text, std::vector<std::string> parameters, FormulaBindings bindings, std::string origin)
    : expression_(std::move(text), std::move(origin)),
      parameters_(std::move(parameters)),
      bindings_(std::move(bindings)) {
  check_names();
  measure_nesting();
  program_ = compile_formula(expression_, parameters_, bindings_);
}

void Formula::check_names() const {
  for (const std::string& name : expression_.variables()) {
    const bool known =
        std::find(parameters_.begin(), parameters_.end(), name) != parameters_.end() || bindings_.contains(name);
    if (known) continue;
    std::vector<std::string> candidates = parameters_;
    for (const auto& [bound, value] : bindings_) candidates.push_back(bound);
    throw DiagnosticError(
        "unknown-name", fmt::format("the formula {} uses {}, which is neither a parameter nor defined", text(), name),
        {expression_.file(), 0, static_cast<std::uint32_t>(text().size())}, did_you_mean(name, candidates));
  }
}

/// Each level takes of the native stack when it is evaluated and when it is given up.
void Formula::measure_nesting() {
  constexpr int deepest = 500;
  for (const auto& [name, value] : bindings_) {
    const RealFunction* function =
        value.is_concept() && value.as_concept()->data ? value.as_concept()->data->real_function() : nullptr;
    if (function != nullptr) nesting_ = std::max(nesting_, function->nesting() + 1);
  }
  if (nesting_ <= deepest) return;
  throw DiagnosticError(
      "limit-depth",
      fmt::format("the formula {} calls a formula that calls another, more than {} deep", text(), deepest),
      {expression_.file(), 0, static_cast<std::uint32_t>(text().size())}, "tabulate what is inside (CALC_FONC_INTERP)");
}

double Formula::evaluate(std::span<const double> arguments) const {
  assert(arguments.size() == parameters_.size());
  if (is_compiled()) {
    std::array<double, 64>
        stack;  // as deep as the compiler allows; not filled, since the program writes before it reads
    assert(program_.depth <= stack.size());
    double result;
    if (program_.run(arguments, stack.data(), result)) return result;
  }
  return evaluate_tree(arguments);
}

Value Formula::evaluate_values(std::span<const Value> arguments) const {
  return expression_.evaluate([&](std::string_view name) -> std::optional<Value> {
    const auto found = std::find(parameters_.begin(), parameters_.end(), name);
    if (found != parameters_.end()) return arguments[static_cast<std::size_t>(found - parameters_.begin())];
    const auto bound = bindings_.find(name);
    return bound == bindings_.end() ? std::nullopt : std::optional(bound->second);
  });
}

double Formula::evaluate_tree(std::span<const double> arguments) const {
  const std::vector<Value> values(arguments.begin(), arguments.end());
  const Value value = evaluate_values(values);
  if (value.is_bool()) return static_cast<double>(value.as_bool());
  if (value.is_number()) return value.as_real();
  throw DiagnosticError("not-real",
                        fmt::format("the formula {} gives {}, which is no real number", text(), value.repr()),
                        {expression_.file(), 0, static_cast<std::uint32_t>(text().size())});
}

}  // namespace comma::interpreter
