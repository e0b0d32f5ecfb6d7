// What the conditions of a command's keywords are judged by.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/formulas/expression.hpp"

namespace comma::interpreter {

/// The keywords that conditions see: those of the level, then those of the levels around it. An absent one is None.
struct KeywordScope {
  const KeywordScope* outer = nullptr;
  std::map<std::string, Value, std::less<>> values;
  bool open = false;  ///< there are further keywords that are not known

  bool any_open() const;
  std::optional<Value> lookup(std::string_view name) const;
};

enum class Truth { no, yes, unknown };

/// Whether a condition holds; unknown where a keyword is not known, or a value of a wrong type is compared, which is
/// reported where it stands.
Truth holds(const Expression& condition, const KeywordScope& scope);

}  // namespace comma::interpreter
