#include "interpreter/catalogue/check_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace comma::interpreter {
namespace {

using RuleKind = RulePage::Kind;

std::string joined(const std::vector<std::string>& names, std::size_t first = 0) {
  return fmt::format("{}", fmt::join(names.begin() + static_cast<std::ptrdiff_t>(first), names.end(), ", "));
}

/// The first of them, where there are too many to read.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t readable = 16;
  constexpr std::ptrdiff_t shown = 12;
  if (names.size() <= readable) return joined(names);
  return fmt::format("{} ...", fmt::join(names.begin(), names.begin() + shown, ", "));
}

/// One rule against what is given.
class RuleCheck {
 public:
  RuleCheck(const RulePage& rule, const std::vector<GivenKeyword>& given, const std::string& label, const Span& span,
            Diagnostics& diagnostics, std::set<std::string>& blamed)
      : rule_(rule), label_(label), span_(span), diagnostics_(diagnostics), blamed_(blamed) {
    for (const GivenKeyword& keyword : given)
      if (std::ranges::find(rule.keywords, keyword.name) != rule.keywords.end()) present_.push_back(&keyword);
  }

  void run() {
    switch (rule_.kind) {
      case RuleKind::exactly_one:
        at_least_one(), at_most_one();
        return;
      case RuleKind::at_least_one:
        at_least_one();
        return;
      case RuleKind::at_most_one:
        at_most_one();
        return;
      case RuleKind::all_or_none:
        all_or_none();
        return;
      case RuleKind::requires_all:
        requires_all();
        return;
      case RuleKind::requires_one:
        requires_one();
        return;
      case RuleKind::excludes:
        excludes();
        return;
    }
  }

 private:
  const GivenKeyword* given(const std::string& name) const {
    const auto found =
        std::ranges::find_if(present_, [&](const GivenKeyword* keyword) { return keyword->name == name; });
    return found == present_.end() ? nullptr : *found;
  }

  void at_least_one() {
    if (!present_.empty()) return;
    diagnostics_.error("missing-one-of", fmt::format("{} needs one of {}", label_, some_of(rule_.keywords)), span_);
  }

  void at_most_one() {
    for (std::size_t i = 1; i < present_.size(); ++i) report_exclusive(*present_[i], *present_.front());
  }

  /// A keyword that several rules exclude is one keyword too many, not several.
  void report_exclusive(const GivenKeyword& second, const GivenKeyword& first) {
    if (first.is_guess || second.is_guess) return;
    if (blamed_.contains(first.name) || blamed_.contains(second.name)) return;
    blamed_.insert({first.name, second.name});
    diagnostics_.error("exclusive-keywords",
                       fmt::format("{} takes {} or {}, not both", label_, first.name, second.name), second.name_span,
                       "keep one of them");
  }

  void all_or_none() {
    if (present_.empty()) return;
    for (const std::string& name : rule_.keywords)
      if (!given(name)) report_required(*present_.front(), name);
  }

  void requires_all() {
    const GivenKeyword* asking = given(rule_.keywords.front());
    if (asking == nullptr) return;
    for (std::size_t i = 1; i < rule_.keywords.size(); ++i)
      if (!given(rule_.keywords[i])) report_required(*asking, rule_.keywords[i]);
  }

  void requires_one() {
    const GivenKeyword* asking = given(rule_.keywords.front());
    if (asking != nullptr && present_.size() == 1) report_required(*asking, "one of " + joined(rule_.keywords, 1));
  }

  void report_required(const GivenKeyword& asking, const std::string& missing) {
    if (asking.is_guess || blamed_.contains(asking.name)) return;
    diagnostics_.error("requires-keyword", fmt::format("{}/{} goes together with {}", label_, asking.name, missing),
                       asking.name_span, fmt::format("add {}", missing));
  }

  void excludes() {
    const GivenKeyword* first = given(rule_.keywords.front());
    if (first == nullptr) return;
    for (const GivenKeyword* other : present_)
      if (other != first) report_exclusive(*other, *first);
  }

  const RulePage& rule_;
  const std::string& label_;
  const Span& span_;
  Diagnostics& diagnostics_;
  std::set<std::string>& blamed_;
  std::vector<const GivenKeyword*> present_;  ///< in the order of the file
};

}  // namespace

void check_rules(const std::vector<RulePage>& rules, const std::vector<GivenKeyword>& given, const std::string& label,
                 const Span& span, Diagnostics& diagnostics) {
  std::set<std::string> blamed;
  const auto run = [&](const RulePage& rule) { RuleCheck(rule, given, label, span, diagnostics, blamed).run(); };
  // First what is too much: a keyword that should not be there asks for no others.
  for (const RulePage& rule : rules)
    if (!rule.asks_for_more()) run(rule);
  for (const RulePage& rule : rules)
    if (rule.asks_for_more()) run(rule);
}

std::string describe_rule(const RulePage& rule) {
  const std::string all = joined(rule.keywords);
  switch (rule.kind) {
    case RuleKind::exactly_one:
      return "exactly one of " + all;
    case RuleKind::at_least_one:
      return "at least one of " + all;
    case RuleKind::at_most_one:
      return "at most one of " + all;
    case RuleKind::all_or_none:
      return "all or none of " + all;
    case RuleKind::requires_all:
      return fmt::format("{} requires {}", rule.keywords.front(), joined(rule.keywords, 1));
    case RuleKind::requires_one:
      return fmt::format("{} requires one of {}", rule.keywords.front(), joined(rule.keywords, 1));
    case RuleKind::excludes:
      return fmt::format("{} excludes {}", rule.keywords.front(), joined(rule.keywords, 1));
  }
  return "";
}

}  // namespace comma::interpreter
