#include "interpreter/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <set>

#include "interpreter/check_reuse.hpp"
#include "interpreter/check_rules.hpp"
#include "interpreter/check_value.hpp"
#include "interpreter/dict.hpp"
#include "interpreter/former_names.hpp"
#include "interpreter/keyword_scope.hpp"

namespace comma::interpreter {
namespace {

/// Calls `visit(keyword, conditions)` for each keyword of a level and of its blocks, whatever their conditions.
template <class Visit>
void visit_keywords(const LevelPage& level, const std::string& conditions, const Visit& visit) {
  for (const KeywordPage& keyword : level.keywords) visit(keyword, conditions);
  for (const BlockPage& block : level.blocks)
    visit_keywords(block.inside, conditions.empty() ? block.when : conditions + " and " + block.when, visit);
}

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
    guess_misspelt();
    for (const Pending& pending : pending_) scope_.values[pending.name] = seen_by_conditions(*pending.argument->value);
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
    visit_keywords(level_, "", [&](const KeywordPage& keyword, const std::string&) {
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
    std::vector<std::string> names;  // in the order of the page, where the likelier ones stand first
    visit_keywords(level_, "", [&](const KeywordPage& keyword, const std::string&) { names.push_back(keyword.name); });
    for (const Pending& pending : pending_) {
      if (std::ranges::find(names, pending.name) != names.end()) continue;
      // Where the user may choose names, only one that stands for what must be there is a mistake.
      std::string meant = of_former_keyword(label_, pending.name);
      if (meant.empty()) meant = nearest(pending.name, level_.further ? missing() : names);
      if (meant.empty() && !level_.further) meant = only_missing();
      if (!meant.empty()) stand_for(pending, meant);
    }
  }

  void stand_for(const Pending& pending, const std::string& meant) {
    if (is_given(meant) || guessed(meant)) return;
    given_.push_back({meant, pending.argument->name_span});
    scope_.values[meant] = Value::unknown();
    guesses_[pending.name] = meant;
  }

  /// The keywords that the level asks for, by themselves or as one of several, and that are not there.
  std::vector<std::string> missing() const {
    std::vector<std::string> names;
    const auto is_there = [&](const std::string& name) { return is_given(name) || guessed(name); };
    for (const KeywordPage& keyword : level_.keywords) {
      if (keyword.required && !is_there(keyword.name)) names.push_back(keyword.name);
    }
    for (const RulePage& rule : level_.rules) {
      const bool asks = rule.kind == RulePage::Kind::exactly_one || rule.kind == RulePage::Kind::at_least_one;
      if (asks && std::ranges::none_of(rule.keywords, is_there))
        names.insert(names.end(), rule.keywords.begin(), rule.keywords.end());
    }
    return names;
  }

  /// The one compulsory keyword, of the level or of a block that stands as long as nothing else is given, that is not
  /// there; empty when there is none, or more.
  std::string only_missing() const {
    KeywordScope given = scope_;
    for (const Pending& pending : pending_) given.values[pending.name] = seen_by_conditions(*pending.argument->value);
    std::vector<std::string> names;
    add_missing(level_, given, names);
    return names.size() == 1 ? names.front() : "";
  }

  void add_missing(const LevelPage& level, const KeywordScope& given, std::vector<std::string>& names) const {
    for (const KeywordPage& keyword : level.keywords)
      if (keyword.required && !is_given(keyword.name) && !guessed(keyword.name)) names.push_back(keyword.name);
    for (const BlockPage& block : level.blocks)
      if (holds(*block.condition, given) == Truth::yes) add_missing(block.inside, given, names);
  }

  bool is_given(const std::string& name) const {
    return std::ranges::find(pending_, name, &Pending::name) != pending_.end();
  }
  bool guessed(const std::string& name) const {
    return std::ranges::any_of(guesses_, [&](const auto& guess) { return guess.second == name; });
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
    } else if (guessed(keyword.name)) {
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
    visit_keywords(level_, "", [&](const KeywordPage& keyword, const std::string&) {
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
    if (!level_.further || guesses_.contains(pending.name)) return report_stray(pending);
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

  /// A keyword that the level does not have, or not now.
  void report_stray(const Pending& pending) {
    std::vector<std::string> conditions, known;
    std::string home;
    visit_keywords(level_, "", [&](const KeywordPage& keyword, const std::string& when) {
      if (keyword.name == pending.name) conditions.push_back(when);
      known.push_back(keyword.name);
      // Of the factors that have it, one that the call writes is meant.
      const bool is_written = std::ranges::any_of(pending_, [&](const Pending& other) { return other.name == home; });
      if (keyword.is_factor() && has_keyword(keyword.inside, pending.name) && !is_written) home = keyword.name;
    });
    const Span& span = pending.argument->name_span;
    if (!conditions.empty()) {
      context_.diagnostics.error(
          "unknown-keyword",
          fmt::format("{} has {} only when {}", label_, pending.name, fmt::join(conditions, ", or ")), span);
      return;
    }
    const auto guess = guesses_.find(pending.name);
    const std::string near = guess == guesses_.end() ? nearest(pending.name, known) : guess->second;
    std::string hint = hint_on_former_keyword(label_, pending.name);
    if (hint.empty() && !home.empty())
      hint = fmt::format("it belongs inside {}=_F(...)", home);
    else if (hint.empty() && !near.empty())
      hint = fmt::format("did you mean {}?", near);
    context_.diagnostics.error("unknown-keyword", fmt::format("{} has no keyword {}", label_, pending.name), span,
                               hint);
  }

  static bool has_keyword(const LevelPage& level, const std::string& name) {
    bool found = false;
    visit_keywords(level, "",
                   [&](const KeywordPage& keyword, const std::string&) { found = found || keyword.name == name; });
    return found;
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
  std::map<std::string, std::string, std::less<>> guesses_;       ///< a misspelt keyword and the one that was meant
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

/// The type of the concept that a keyword names, if it is of the kind that the product is.
std::string type_like(const ProductPage& product, const Keywords& keywords, const Catalogue& catalogue) {
  const auto named = std::ranges::find(keywords.items, product.like, &Keyword::name);
  const bool fits = named != keywords.items.end() && named->value.is_concept() &&
                    catalogue.is_a(named->value.as_concept()->type, product.type);
  return fits ? named->value.as_concept()->type : product.type;
}

/// Nothing where it depends on a value that is not known.
std::optional<std::string> product_type(const CommandPage& page, const KeywordScope& scope, const Keywords& keywords,
                                        const Catalogue& catalogue) {
  for (const ProductPage& product : page.products) {
    const Truth fits = product.condition == nullptr ? Truth::yes : holds(*product.condition, scope);
    if (fits == Truth::unknown) return std::nullopt;
    if (fits == Truth::yes) return product.like.empty() ? product.type : type_like(product, keywords, catalogue);
  }
  return "";
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
  const auto type = product_type(page, level.scope(), checked.call, catalogue);
  checked.product_type = type.value_or("");
  checked.product_is_open = !type;
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
