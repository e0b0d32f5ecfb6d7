#include "interpreter/catalogue/stray_keywords.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "interpreter/catalogue/former_names.hpp"

namespace comma::interpreter {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// In the order of the page, where the likelier ones stand first.
std::vector<std::string> names_of(const LevelPage& level) {
  std::vector<std::string> names;
  visit_keywords(level, [&](const KeywordPage& keyword, const std::string&) { names.push_back(keyword.name); });
  return names;
}

/// Guesses for one level, each made knowing those before it.
class Guessing {
 public:
  Guessing(const LevelPage& level, const std::string& label, const std::vector<std::string>& written,
           const KeywordScope& scope, std::vector<std::string> names)
      : level_(level), label_(label), written_(written), scope_(scope), names_(std::move(names)) {}

  std::vector<KeywordGuess> run() {
    for (const std::string& name : written_) {
      if (contains(names_, name)) continue;
      const std::string meant = guess(name);
      if (meant.empty() || is_there(meant)) continue;
      scope_.values[meant] = Value::unknown();
      guesses_.push_back({name, meant});
    }
    return std::move(guesses_);
  }

 private:
  std::string guess(const std::string& name) const {
    std::string meant = of_former_keyword(label_, name);
    // Where the user may choose names, only one that stands for what must be there is a mistake.
    if (meant.empty()) meant = nearest(name, level_.further ? missing() : names_);
    if (meant.empty() && !level_.further) meant = only_missing();
    return meant;
  }

  bool is_there(const std::string& name) const {
    return contains(written_, name) || std::ranges::find(guesses_, name, &KeywordGuess::meant) != guesses_.end();
  }

  /// The keywords that the level asks for, by themselves or as one of several, and that are not there.
  std::vector<std::string> missing() const {
    std::vector<std::string> names;
    for (const KeywordPage& keyword : level_.keywords)
      if (keyword.required && !is_there(keyword.name)) names.push_back(keyword.name);
    for (const RulePage& rule : level_.rules) {
      const bool asks = rule.kind == RulePage::Kind::exactly_one || rule.kind == RulePage::Kind::at_least_one;
      if (asks && std::ranges::none_of(rule.keywords, [&](const std::string& name) { return is_there(name); }))
        names.insert(names.end(), rule.keywords.begin(), rule.keywords.end());
    }
    return names;
  }

  /// The one compulsory keyword, of the level or of a block that stands as long as nothing else is given, that is not
  /// there; empty when there is none, or more.
  std::string only_missing() const {
    std::vector<std::string> names;
    add_missing(level_, names);
    return names.size() == 1 ? names.front() : "";
  }

  void add_missing(const LevelPage& level, std::vector<std::string>& names) const {
    for (const KeywordPage& keyword : level.keywords)
      if (keyword.required && !is_there(keyword.name)) names.push_back(keyword.name);
    for (const BlockPage& block : level.blocks)
      if (holds(*block.condition, scope_) == Truth::yes) add_missing(block.inside, names);
  }

  const LevelPage& level_;
  const std::string& label_;
  const std::vector<std::string>& written_;
  KeywordScope scope_;
  std::vector<std::string> names_;
  std::vector<KeywordGuess> guesses_;
};

/// The conditions under which the level has the keyword; empty when it never has.
std::vector<std::string> conditions_of(const LevelPage& level, const std::string& name) {
  std::vector<std::string> found;
  visit_keywords(level, [&](const KeywordPage& keyword, const std::string& conditions) {
    if (keyword.name == name) found.push_back(conditions);
  });
  return found;
}

/// The factor of the level that has the keyword, one that is written if there is such; empty when none has it.
std::string factor_with(const LevelPage& level, const std::string& name, const std::vector<std::string>& written) {
  std::string factor;
  visit_keywords(level, [&](const KeywordPage& keyword, const std::string&) {
    if (keyword.is_factor() && !conditions_of(keyword.inside, name).empty() && !contains(written, factor))
      factor = keyword.name;
  });
  return factor;
}

std::string hint_on_stray(const LevelPage& level, const std::string& label, const std::string& name,
                          const std::vector<std::string>& written, const std::string& meant) {
  if (const std::string hint = hint_on_former_keyword(label, name); !hint.empty()) return hint;
  if (const std::string factor = factor_with(level, name, written); !factor.empty())
    return fmt::format("it belongs inside {}=_F(...)", factor);
  const std::string near = meant.empty() ? nearest(name, names_of(level)) : meant;
  return near.empty() ? "" : fmt::format("did you mean {}?", near);
}

}  // namespace

std::vector<KeywordGuess> guesses_of_misspelt(const LevelPage& level, const std::string& label,
                                              const std::vector<std::string>& written, const KeywordScope& scope) {
  std::vector<std::string> names = names_of(level);
  if (std::ranges::all_of(written, [&](const std::string& name) { return contains(names, name); })) return {};
  return Guessing(level, label, written, scope, std::move(names)).run();
}

void report_stray_keyword(const LevelPage& level, const std::string& label, const GivenKeyword& stray,
                          const std::vector<std::string>& written, const std::string& meant, Diagnostics& diagnostics) {
  const std::vector<std::string> conditions = conditions_of(level, stray.name);
  if (conditions.empty())
    diagnostics.error("unknown-keyword", fmt::format("{} has no keyword {}", label, stray.name), stray.name_span,
                      hint_on_stray(level, label, stray.name, written, meant));
  else
    diagnostics.error("unknown-keyword",
                      fmt::format("{} has {} only when {}", label, stray.name, fmt::join(conditions, ", or ")),
                      stray.name_span);
}

}  // namespace comma::interpreter
