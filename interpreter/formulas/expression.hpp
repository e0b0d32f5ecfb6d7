// One expression of the command language by itself: the condition of a catalogue block, the formula of FORMULE.
// It has the language's operators, builtins and `math` names, but no commands and no statements.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/diagnostic.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

struct Node;

/// The value of a variable, or nothing when there is none of that name.
using VariableLookup = std::function<std::optional<Value>(std::string_view)>;

/// A parsed expression. Parse once, evaluate often; copies share the tree.
///
///     Expression condition("FORMULATION == 'DISCRETE' and ALGO_CONT in ('CONTRAINTE', 'GCP')");
///     bool holds = condition.holds([&](std::string_view name) { return keyword_or_none(name); });
class Expression {
 public:
  /// `origin` names the text in messages. Throws DiagnosticError (code "syntax") when it is no expression.
  explicit Expression(std::string text, std::string origin = "<expression>");

  /// The value with the variables given by `lookup`; names it does not know are looked for among the builtins and
  /// `math`. Throws DiagnosticError ("unknown-name", "type-error", "zero-division" ...) with a span in the text.
  Value evaluate(const VariableLookup& lookup) const;

  /// Python's truth of the value.
  bool holds(const VariableLookup& lookup) const;

  /// The free names in order of first use, builtins and `math` functions left out: what the expression depends on.
  const std::vector<std::string>& variables() const { return variables_; }

  /// All its free names, builtins and `math` functions too, once each.
  const std::vector<std::string>& names() const { return names_; }

  const std::string& text() const { return text_; }
  const Node& root() const;
  const std::shared_ptr<const SourceFile>& file() const;

 private:
  struct Tree;
  std::string text_;
  std::shared_ptr<const Tree> tree_;
  std::vector<std::string> names_;
  std::vector<std::string> variables_;
};

}  // namespace comma::interpreter
