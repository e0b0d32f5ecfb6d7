#include "interpreter/catalogue/expression_keywords.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "interpreter/formulas/expression.hpp"
#include "interpreter/library/builtins.hpp"

namespace comma::interpreter {

namespace {

bool holds(const KeywordPage& keyword, Kind kind) {
  return std::ranges::any_of(keyword.types, [kind](const TypePage& type) { return type.kind == kind; });
}

const Argument* find_argument(const CommandCall& call, const std::string& name) {
  const auto found = std::ranges::find(call.arguments, name, &Argument::name);
  return found == call.arguments.end() ? nullptr : &*found;
}

/// Whether the call says which variables its expressions have: without that, none of their names can be judged.
bool names_variables(const CommandCall& call, const LevelPage& level) {
  const auto is_text = [](const Value& value) { return value.is_text(); };
  return std::ranges::any_of(level.keywords, [&](const KeywordPage& keyword) {
    const Argument* argument = holds(keyword, Kind::parameter) ? find_argument(call, keyword.name) : nullptr;
    if (argument == nullptr) return false;
    const Value& value = *argument->value;
    return value.is_sequence() ? std::ranges::all_of(value.items(), is_text) : value.is_text();
  });
}

/// The names that need no binding: other arguments, and what the keywords of type `parameter` list.
std::set<std::string, std::less<>> own_names(const CommandCall& call, const LevelPage& level) {
  std::set<std::string, std::less<>> names;
  for (const Argument& argument : call.arguments) names.insert(argument.name);
  for (const KeywordPage& keyword : level.keywords) {
    const Argument* argument = holds(keyword, Kind::parameter) ? find_argument(call, keyword.name) : nullptr;
    if (argument == nullptr) continue;
    const Value& value = *argument->value;
    if (value.is_text()) names.insert(value.as_text());
    if (!value.is_sequence()) continue;
    for (const Value& item : value.items()) {
      if (item.is_text()) names.insert(item.as_text());
    }
  }
  return names;
}

std::optional<Expression> read_expression(const Argument& argument, Diagnostics& diagnostics) {
  try {
    return Expression(argument.value->as_text(), argument.name);
  } catch (const DiagnosticError& error) {
    const Diagnostic& found = error.diagnostic();
    const int column = found.span ? found.span.file->position(found.span.begin).column : 1;
    diagnostics.error("syntax",
                      fmt::format("{}, at character {} of the expression: {}", argument.name, column, found.message),
                      argument.value_span, found.hint);
    return std::nullopt;
  }
}

class Binder {
 public:
  Binder(CommandCall& call, const CommandPage& page, Diagnostics& diagnostics)
      : call_(call),
        diagnostics_(diagnostics),
        own_(own_names(call, page.inside)),
        judges_names_(names_variables(call, page.inside)) {}

  bool bind(const Argument& argument) {
    const auto expression = read_expression(argument, diagnostics_);
    if (!expression) return false;
    bool sound = true;
    for (const std::string& name : expression->names()) sound = bind_name(name, argument) && sound;
    return sound;
  }

 private:
  bool bind_name(const std::string& name, const Argument& argument) {
    if (own_.contains(name) || !call_.scope) return true;
    if (auto value = call_.scope(name)) {
      own_.insert(name);
      call_.arguments.push_back(
          {name, argument.value_span, std::make_shared<const Value>(std::move(*value)), argument.value_span});
      return true;
    }
    if (builtin_value(name) != nullptr || math_value(name) != nullptr) return true;
    if (!judges_names_) return true;  // that a keyword is missing or wrong is told by the syntax
    own_.insert(name);
    const std::string near = nearest(name, {own_.begin(), own_.end()});
    diagnostics_.error(
        "unknown-name",
        fmt::format("{} uses {}, which is neither a parameter nor defined before this line", argument.name, name),
        argument.value_span, near.empty() || near == name ? "" : fmt::format("did you mean {}?", near));
    return false;
  }

  CommandCall& call_;
  Diagnostics& diagnostics_;
  std::set<std::string, std::less<>> own_;
  bool judges_names_;
};

}  // namespace

bool bind_expressions(CommandCall& call, const CommandPage& page, Diagnostics& diagnostics) {
  if (!page.inside.further) return true;
  Binder binder(call, page, diagnostics);
  bool sound = true;
  for (const KeywordPage& keyword : page.inside.keywords) {
    const Argument* argument = holds(keyword, Kind::expression) ? find_argument(call, keyword.name) : nullptr;
    if (argument == nullptr || !argument->value->is_text()) continue;
    const Argument copy = *argument;  // binding adds arguments
    sound = binder.bind(copy) && sound;
  }
  return sound;
}

}  // namespace comma::interpreter
