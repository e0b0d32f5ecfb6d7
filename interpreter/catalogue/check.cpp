#include "interpreter/catalogue/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <set>

#include "interpreter/catalogue/check_reuse.hpp"
#include "interpreter/catalogue/check_rules.hpp"
#include "interpreter/catalogue/check_value.hpp"
#include "interpreter/catalogue/keyword_scope.hpp"
#include "interpreter/catalogue/product_type.hpp"
#include "interpreter/catalogue/stray_keywords.hpp"
#include "interpreter/values/dict.hpp"

namespace comma::interpreter {
namespace {

/// An argument of the level on its way to its keyword.
struct Pending {
  std::string name;  ///< the catalogue's name, when it was written with an older one
  const Argument* argument = nullptr;
  bool used = false;
};

/// One _F(...) of a factor keyword.
struct Occurrence {
  std::vector<Argument> arguments;
  Span span;
  bool open = false;
};

/// Of _F(...), or of a dict with text keys, which stands for it.
std::optional<Occurrence> occurrence_of(const Value& value, const Span& otherwise) {
  if (!value.is_dict()) return std::nullopt;
  const FactorPlaces* written = value.as_dict().factor.get();
  const Span span = written != nullptr && written->span ? written->span : otherwise;
  auto keywords = keywords_of(value.as_dict(), span);
  if (!keywords) return std::nullopt;
  return Occurrence{std::move(*keywords), span, written != nullptr && written->open};
}

/// A single _F(...) or dict, or a tuple or list of them; unknown ones are left out.
std::optional<std::vector<Occurrence>> occurrences_of(const Value& value, const Span& span) {
  std::vector<Value> items{value};
  if (value.is_sequence()) items.assign(value.items().begin(), value.items().end());
  std::vector<Occurrence> occurrences;
  for (const Value& item : items) {
    if (item.is_unknown()) continue;
    auto occurrence = occurrence_of(item, span);
    if (!occurrence) return std::nullopt;
    occurrences.push_back(std::move(*occurrence));
  }
  return occurrences;
}

/// Checks one level: the keywords of a call, or of one occurrence of a factor.
class LevelCheck {
 public:
  LevelCheck(const LevelPage& level, std::string label, Span span, const KeywordScope* outer, CheckContext& context)
      : level_(level), label_(std::move(label)), span_(std::move(span)), context_(context) {
    scope_.outer = outer;
    result_.span = span_;
  }

  /// `open`: besides the arguments there may be others.
  Keywords run(const std::vector<Argument>& arguments, bool open) {
    scope_.open = open;
    context_.met_open = context_.met_open || open;
    resolve(arguments);
    for (const Pending& pending : pending_) scope_.values[pending.name] = seen_by_conditions(*pending.argument->value);
    guess_misspelt();
    forget_wrong_values();
    activate(level_, true);
    for (const Pending& pending : pending_)
      if (!pending.used) take_other(pending);
    warn_of_idle();
    return std::move(result_);
  }

  const KeywordScope& scope() const { return scope_; }
  /// Conditions see reuse= as a keyword.
  void note_reuse(bool reused) { scope_.values["reuse"] = reused ? Value(true) : Value(); }

 private:
  /// A factor keyword is True for conditions: they only ask whether it is there.
  static Value seen_by_conditions(const Value& value) { return value.is_dict() ? Value(true) : value; }

  void resolve(const std::vector<Argument>& arguments) {
    std::map<std::string, std::string, std::less<>> canonical;
    std::set<std::string, std::less<>> factors;
    visit_keywords(level_, [&](const KeywordPage& keyword, const std::string&) {
      for (const std::string& alias : keyword.aliases) canonical.emplace(alias, keyword.name);
      if (keyword.is_factor()) factors.insert(keyword.name);
    });
    for (const Argument& argument : arguments) {
      // KEYWORD=None and FACTOR=() are Code_Aster's ways to leave a keyword out.
      const Value& value = *argument.value;
      if (value.is_none()) continue;
      const auto alias = canonical.find(argument.name);
      const std::string& name = alias == canonical.end() ? argument.name : alias->second;
      if (value.is_sequence() && value.items().empty() && factors.contains(name)) continue;
      add_pending({name, &argument, false});
    }
  }

  /// What depends on a compulsory keyword that is missing, or that has a wrong value, is not known: one mistake makes
  /// one error.
  void forget_wrong_values() {
    for (const KeywordPage& keyword : level_.keywords) {
      if (keyword.is_factor()) continue;
      const auto pending = std::ranges::find(pending_, keyword.name, &Pending::name);
      if (pending == pending_.end()) {
        if (keyword.required) scope_.values[keyword.name] = Value::unknown();
        continue;
      }
      if (!fits(keyword, *pending->argument)) scope_.values[keyword.name] = Value::unknown();
    }
  }

  /// A misspelt keyword stands for the one that was probably meant: that one is not missing as well, and what depends
  /// on it is not known.
  void guess_misspelt() {
    for (const Pending& pending : pending_) written_.push_back(pending.name);
    guesses_ = guesses_of_misspelt(level_, label_, written_, scope_);
    for (const KeywordGuess& guess : guesses_) {
      const auto pending = std::ranges::find(pending_, guess.written, &Pending::name);
      given_.push_back({guess.meant, pending->argument->name_span, true});
      scope_.values[guess.meant] = Value::unknown();
    }
  }

  void add_pending(Pending pending) {
    const bool twice = std::ranges::any_of(pending_, [&](const Pending& other) { return other.name == pending.name; });
    if (!twice) {
      given_.push_back({pending.name, pending.argument->name_span});
      pending_.push_back(std::move(pending));
      return;
    }
    const auto& other = std::ranges::find(pending_, pending.name, &Pending::name)->argument->name;
    const bool older = pending.name != pending.argument->name;
    const std::string also = !older ? "" : fmt::format(" ({} is its older name)", pending.argument->name);
    const bool merge = (older || other != pending.name) && pending.argument->value->is_factor();
    context_.diagnostics.error(
        "duplicate-keyword", fmt::format("{} is given {} twice{}", label_, pending.name, also),
        pending.argument->name_span,
        merge ? fmt::format("write both as occurrences of one: {}=(_F(...), _F(...))", pending.name)
              : "keep one of them");
  }

  /// `certain` is false in a block whose condition depends on a value that is unknown: nothing is missing there.
  void activate(const LevelPage& level, bool certain) {
    for (const KeywordPage& keyword : level.keywords) take(keyword, certain);
    if (certain && !scope_.open) check_rules(level.rules, given_, label_, span_, context_.diagnostics);
    for (const BlockPage& block : level.blocks) {
      const Truth truth = holds(*block.condition, scope_);
      if (truth != Truth::no) activate(block.inside, certain && truth == Truth::yes);
    }
  }

  void take(const KeywordPage& keyword, bool certain) {
    if (!defined_.insert(keyword.name).second) return;
    const auto pending = std::ranges::find(pending_, keyword.name, &Pending::name);
    if (pending != pending_.end()) {
      pending->used = true;
      if (certain || only_page(keyword) || fits_no_page(keyword.name, *pending->argument)) {
        take_given(keyword, *pending->argument);
      } else {
        take_unjudged(keyword, *pending->argument);
      }
    } else if (std::ranges::find(guesses_, keyword.name, &KeywordGuess::meant) != guesses_.end()) {
      return;
    } else if (certain && !scope_.open) {
      take_default(keyword);
    } else {
      scope_.values[keyword.name] =
          Value::unknown();  // it may be given, or its default would stand here if the block exists
    }
  }

  std::vector<const KeywordPage*> pages_of(const std::string& name) const {
    std::vector<const KeywordPage*> pages;
    visit_keywords(level_, [&](const KeywordPage& keyword, const std::string&) {
      if (keyword.name == name) pages.push_back(&keyword);
    });
    return pages;
  }
  bool only_page(const KeywordPage& keyword) const { return pages_of(keyword.name).size() == 1; }

  /// Whether the value is wrong in whichever of the blocks the keyword may be meant.
  bool fits_no_page(const std::string& name, const Argument& argument) const {
    return std::ranges::none_of(pages_of(name),
                                [&](const KeywordPage* page) { return page->is_factor() || fits(*page, argument); });
  }

  bool fits(const KeywordPage& page, const Argument& argument) const {
    Diagnostics nothing;
    CheckContext context{context_.catalogue, nothing};
    context.quiet = true;
    return check_value(*argument.value, page, label_, argument.value_span, context).has_value();
  }

  /// A keyword of a block that may not be the right one: other blocks may describe it otherwise.
  void take_unjudged(const KeywordPage& keyword, const Argument& argument) {
    result_.items.push_back({keyword.name, Value::unknown(), {}, argument.name_span, argument.value_span, true});
    scope_.values[keyword.name] = Value::unknown();
  }

  /// A name that no keyword has: one that the user chose, where the level admits such, else a mistake.
  void take_other(const Pending& pending) {
    const auto guess = std::ranges::find(guesses_, pending.name, &KeywordGuess::written);
    if (!level_.further || guess != guesses_.end())
      return report_stray_keyword(level_, label_, {pending.name, pending.argument->name_span}, written_,
                                  guess == guesses_.end() ? "" : guess->meant, context_.diagnostics);
    KeywordPage keyword = *level_.further;
    keyword.name = pending.name;
    take_given(keyword, *pending.argument);
  }

  /// What is written and nothing reads.
  void warn_of_idle() {
    for (const auto& [keyword, span] : conditional_)
      if (holds(*keyword->counts, scope_) == Truth::no)
        context_.diagnostics.alarm(
            "idle-keyword",
            fmt::format("{}/{} has no effect here: it counts when {}", label_, keyword->name, keyword->counts_when),
            span, "leave it out, or give what it belongs to");
  }

  void take_given(const KeywordPage& keyword, const Argument& argument) {
    const std::string label = label_ + "/" + keyword.name;
    const bool was_quiet = context_.quiet;
    if (keyword.counts) conditional_.emplace_back(&keyword, argument.name_span);
    if (!keyword.supported) {
      context_.report_unsupported(fmt::format("comma does not support {} yet", label), argument.name_span);
      context_.quiet = true;
    }
    Keyword item{keyword.name, Value(), {}, argument.name_span, argument.value_span, true};
    const bool right =
        keyword.is_factor() ? take_factor(keyword, argument, label, item) : take_value(keyword, argument, label, item);
    if (right && keyword.missed) warn_of_missed(keyword, label, item);
    if (right) result_.items.push_back(std::move(item));
    context_.quiet = was_quiet;
  }

  /// What asks for something that comma does not give.
  void warn_of_missed(const KeywordPage& keyword, const std::string& label, const Keyword& item) {
    if (keyword.default_value && keyword.default_value->repr() == item.value.repr()) return;
    context_.diagnostics.alarm("idle-keyword", fmt::format("{} has no effect: {}", label, keyword.no_effect),
                               item.name_span, "leave it out");
  }

  bool take_value(const KeywordPage& keyword, const Argument& argument, const std::string& label, Keyword& item) {
    context_.level = &level_;
    auto value = check_value(*argument.value, keyword, label, argument.value_span, context_);
    if (!value) {
      scope_.values[keyword.name] = Value::unknown();  // a condition on a wrong value would only make further errors
      return false;
    }
    item.value = std::move(*value);
    scope_.values[keyword.name] = item.value;
    return true;
  }

  bool take_factor(const KeywordPage& keyword, const Argument& argument, const std::string& label, Keyword& item) {
    scope_.values[keyword.name] = Value(true);
    if (argument.value->is_unknown()) {
      item.value = *argument.value;
      return true;
    }
    const auto occurrences = occurrences_of(*argument.value, argument.value_span);
    if (!occurrences) {
      context_.diagnostics.error("wrong-type", fmt::format("{} wants _F(...), not {}", label, argument.value->repr()),
                                 argument.value_span, fmt::format("write {}=_F(...)", keyword.name));
      return false;
    }
    check_occurrence_count(keyword, label, occurrences->size(), argument.value_span);
    for (const Occurrence& occurrence : *occurrences)
      item.factors.push_back(check_occurrence(keyword, occurrence, label));
    return true;
  }

  void check_occurrence_count(const KeywordPage& keyword, const std::string& label, std::size_t count,
                              const Span& span) {
    const std::string wanted = describe_count(keyword.min_count, keyword.max_count, "occurrence");
    const bool too_many = keyword.max_count != unlimited && count > static_cast<std::size_t>(keyword.max_count);
    if (too_many)
      context_.diagnostics.error("too-many-occurrences", fmt::format("{} takes {}, not {}", label, wanted, count),
                                 span);
    else if (count < static_cast<std::size_t>(keyword.min_count))
      context_.diagnostics.error("wrong-count", fmt::format("{} takes {}, not {}", label, wanted, count), span);
  }

  Keywords check_occurrence(const KeywordPage& keyword, const Occurrence& occurrence, const std::string& label) {
    return LevelCheck(keyword.inside, label, occurrence.span, &scope_, context_)
        .run(occurrence.arguments, occurrence.open);
  }

  void take_default(const KeywordPage& keyword) {
    if (keyword.required) {
      context_.diagnostics.error("missing-keyword", fmt::format("{} needs {}", label_, keyword.name), span_,
                                 fmt::format("write {}=...: {}", keyword.name, keyword.doc));
      return;
    }
    Keyword item{keyword.name, Value(), {}, Span(), Span(), false};
    if (keyword.present_by_default) {
      item.factors.push_back(check_occurrence(keyword, {{}, span_, false}, label_ + "/" + keyword.name));
    } else if (keyword.default_value) {
      item.value = default_of(keyword);
      scope_.values[keyword.name] = item.value;
    } else {
      return;
    }
    result_.items.push_back(std::move(item));
  }

  /// Defaults obey their page (the build checks it), so nothing can be reported here.
  Value default_of(const KeywordPage& keyword) const {
    Diagnostics nothing;
    CheckContext context{context_.catalogue, nothing};
    auto value = check_value(*keyword.default_value, keyword, keyword.name, Span(), context);
    assert(value);
    return value ? *value : Value::unknown();
  }

  const LevelPage& level_;
  std::string label_;
  Span span_;
  CheckContext& context_;
  KeywordScope scope_;
  std::vector<Pending> pending_;
  std::vector<GivenKeyword> given_;
  std::set<std::string, std::less<>> defined_;
  std::vector<std::pair<const KeywordPage*, Span>> conditional_;  ///< given, and of effect under a condition alone
  std::vector<std::string> written_;                              ///< the names of `pending_`
  std::vector<KeywordGuess> guesses_;
  Keywords result_;
};

bool holds_unknown(const Keywords& keywords);

bool holds_unknown(const Keyword& keyword) {
  if (keyword.value.is_unknown()) return true;
  if (keyword.value.is_sequence() && std::ranges::any_of(keyword.value.items(), &Value::is_unknown)) return true;
  return std::ranges::any_of(keyword.factors, [](const Keywords& factor) { return holds_unknown(factor); });
}

bool holds_unknown(const Keywords& keywords) {
  return std::ranges::any_of(keywords.items, [](const Keyword& keyword) { return holds_unknown(keyword); });
}

std::size_t count_errors(const Diagnostics& diagnostics) {
  return static_cast<std::size_t>(std::ranges::count(diagnostics.items(), Severity::error, &Diagnostic::severity));
}

}  // namespace

CheckedCall check_call(const CommandCall& written, const CommandPage& page, const Catalogue& catalogue,
                       Diagnostics& diagnostics, Severity unsupported) {
  const std::size_t errors_before = count_errors(diagnostics);
  CheckContext context{catalogue, diagnostics, unsupported};
  // No verdict depends on what is printed.
  if (only_writes(page.role)) {
    context.unsupported = Severity::alarm;
    context.without = fmt::format("{} is left out here, and writes nothing; all else runs", page.name);
  }
  if (!page.supported) {
    context.report_unsupported(fmt::format("comma does not support {} yet", page.name), written.name_span);
    context.quiet = true;
  }

  const auto reuse = std::ranges::find(written.arguments, "reuse", &Argument::name);
  // Editors number the commands that they write (identifier="3:1"), and no command takes that for anything.
  std::vector<Argument> arguments;
  std::ranges::copy_if(written.arguments, std::back_inserter(arguments),
                       [](const Argument& a) { return a.name != "reuse" && a.name != "identifier"; });

  LevelCheck level(page.inside, page.name, written.name_span, nullptr, context);
  level.note_reuse(reuse != written.arguments.end() && !reuse->value->is_none());
  CheckedCall checked;
  static_cast<Keywords&>(checked.call) = level.run(arguments, written.open);
  checked.call.span = written.span;
  checked.call.command = page.name;
  checked.product_type = product_type(page, level.scope(), checked.call, catalogue);
  const bool reused = reuse != written.arguments.end() && !reuse->value->is_none();
  check_reuse(written, page, reused ? &*reuse : nullptr, context, checked);

  checked.sound = count_errors(diagnostics) == errors_before;
  checked.left_out = only_writes(page.role) && checked.sound && context.met_unsupported;
  const bool unknown_reuse = reused && reuse->value->is_unknown();
  checked.complete =
      checked.sound && !context.met_unsupported && !context.met_open && !unknown_reuse && !holds_unknown(checked.call);
  return checked;
}

}  // namespace comma::interpreter
