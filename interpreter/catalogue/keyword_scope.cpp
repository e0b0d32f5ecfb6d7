#include "interpreter/catalogue/keyword_scope.hpp"

#include <algorithm>

namespace comma::interpreter {

bool KeywordScope::any_open() const { return open || (outer != nullptr && outer->any_open()); }

std::optional<Value> KeywordScope::lookup(std::string_view name) const {
  for (const KeywordScope* scope = this; scope != nullptr; scope = scope->outer)
    if (const auto found = scope->values.find(name); found != scope->values.end()) return found->second;
  return std::nullopt;
}

Truth holds(const Expression& condition, const KeywordScope& scope) {
  const auto lookup = [&](std::string_view name) -> std::optional<Value> {
    if (auto value = scope.lookup(name)) return value;
    const bool keyword = std::ranges::find(condition.variables(), name) != condition.variables().end();
    if (!keyword) return std::nullopt;
    return scope.any_open() ? Value::unknown() : Value();
  };
  try {
    if (condition.evaluate(lookup).is_unknown()) return Truth::unknown;
    return condition.holds(lookup) ? Truth::yes : Truth::no;
  } catch (const DiagnosticError&) {
    return Truth::unknown;
  }
}

}  // namespace comma::interpreter
