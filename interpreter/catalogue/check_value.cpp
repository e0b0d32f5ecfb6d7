#include "interpreter/catalogue/check_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "interpreter/catalogue/former_names.hpp"
#include "interpreter/item_span.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/objects.hpp"

namespace comma::interpreter {
namespace {

std::string describe_kind(Kind kind) {
  switch (kind) {
    case Kind::real:
      return "a real number";
    case Kind::integer:
      return "an integer";
    case Kind::complex:
      return "a complex number";
    case Kind::text:
      return "a text";
    case Kind::expression:
      return "an expression, as a text";
    case Kind::node_group:
      return "the name of a node group";
    case Kind::cell_group:
      return "the name of a cell group";
    case Kind::node:
      return "the name of a node";
    case Kind::cell:
      return "the name of a cell";
    case Kind::component:
      return "the name of a component";
    case Kind::field:
      return "the name of a field";
    case Kind::parameter:
      return "the name of a parameter";
    case Kind::input_unit:
    case Kind::output_unit:
      return "a file unit (an integer)";
    case Kind::concept_kind:
      return "a concept";
    case Kind::anything:
      return "a value";
    case Kind::factor:
      return "_F(...)";
  }
  return "";
}

std::string describe_type(const TypePage& type, const Catalogue& catalogue) {
  if (type.kind != Kind::concept_kind) return describe_kind(type.kind);
  if (type.concept_type == "any") return "a concept";
  return fmt::format("{} ({})", with_article(catalogue.describe_type(type.concept_type)), type.concept_type);
}

/// What was written, in words: "the text 'abc'", "MA, a mesh (maillage_sdaster)".
std::string describe_value(const Value& value, const Catalogue& catalogue) {
  constexpr std::size_t longest_shown = 40;
  if (value.is_concept()) {
    const Concept& handle = *value.as_concept();
    return fmt::format("{}, {} ({})", handle.name, with_article(catalogue.describe_type(handle.type)), handle.type);
  }
  if (value.is_factor()) return "_F(...)";
  std::string shown = value.repr();
  if (shown.size() > longest_shown) shown.replace(longest_shown, std::string::npos, "...");
  if (value.is_text()) return "the text " + shown;
  if (value.is_number()) return shown;
  return fmt::format("{} ({})", shown, value.type_name());
}

/// ('RI', real, imaginary) and ('MP', modulus, phase in degrees): Code_Aster's way to write a complex number.
bool is_complex_triple(const Value& value) {
  if (!value.is_sequence() || value.items().size() != 3) return false;
  const auto items = value.items();
  if (!items[0].is_text() || !items[1].is_number() || !items[2].is_number()) return false;
  return items[0].as_text() == "RI" || items[0].as_text() == "MP";
}

std::complex<double> complex_from_triple(const Value& value) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const auto items = value.items();
  const double first = items[1].as_real(), second = items[2].as_real();
  return items[0].as_text() == "RI" ? std::complex<double>(first, second) : std::polar(first, second * degree);
}

std::optional<Value> convert(const Value& value, const TypePage& type, const Catalogue& catalogue) {
  switch (type.kind) {
    case Kind::real:
      return value.is_number() ? std::optional(Value(value.as_real())) : std::nullopt;
    case Kind::integer:
    case Kind::input_unit:
    case Kind::output_unit:
      return value.is_integer() ? std::optional(value) : std::nullopt;
    case Kind::complex:
      if (is_complex_triple(value)) return Value(complex_from_triple(value));
      return value.is_number() || value.is_complex() ? std::optional(Value(value.as_complex())) : std::nullopt;
    case Kind::concept_kind:
      return value.is_concept() && catalogue.is_a(value.as_concept()->type, type.concept_type) ? std::optional(value)
                                                                                               : std::nullopt;
    case Kind::factor:
      return std::nullopt;
    case Kind::node_group:
    case Kind::cell_group:
    case Kind::node:
    case Kind::cell:
    case Kind::component:
    case Kind::field:
    case Kind::parameter:
      // Names have fixed lengths in Code_Aster: blanks at their ends do not count.
      if (value.is_text() && value.as_text().ends_with(' '))
        return Value(value.as_text().substr(0, value.as_text().find_last_not_of(' ') + 1));
      [[fallthrough]];
    default:
      return value.is_text() ? std::optional(value) : std::nullopt;
  }
}

bool is_number(const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  return read.ec == std::errc() && read.ptr == end;
}

bool admits(const KeywordPage& page, Kind kind) {
  return std::ranges::any_of(page.types, [kind](const TypePage& type) { return type.kind == kind; });
}

bool same_word(const Value& value, const Value& word) {
  if (value.is_text() && word.is_text()) return value.as_text() == word.as_text();
  if (value.is_number() && word.is_number()) return value.as_real() == word.as_real();
  return false;
}

bool within(double number, const Bounds& bounds) {
  if (bounds.above && !(number > *bounds.above)) return false;
  if (bounds.at_least && !(number >= *bounds.at_least)) return false;
  if (bounds.below && !(number < *bounds.below)) return false;
  return !bounds.at_most || number <= *bounds.at_most;
}

/// Counts and numbers of things are no larger; a page that gives a bound of its own (at_most) admits more.
constexpr std::int64_t most_counted = std::numeric_limits<std::int32_t>::max();

bool fits(const Value& integer) {
  return integer.as_integer() <= most_counted && integer.as_integer() >= -most_counted;
}

/// A vector of numpy counts as the tuple of its numbers, everything else as itself.
Value without_array(const Value& value) {
  const auto* array = value.as_object<ArrayObject>();
  if (array == nullptr || array->shape.size() != 1) return value;
  const Value numbers = array->to_list();
  return Value::tuple({numbers.items().begin(), numbers.items().end()});
}

/// The checks of one keyword's value, element by element.
class ValueCheck {
 public:
  ValueCheck(const KeywordPage& page, const std::string& label, const Span& span, CheckContext& context)
      : page_(page), label_(label), span_(span), context_(context) {}

  std::optional<Value> run(const Value& given) {
    const Value value = without_array(given);
    if (value.is_unknown() || admits(page_, Kind::anything)) return value;
    const bool several = value.is_sequence() && !(admits(page_, Kind::complex) && is_complex_triple(value));
    std::vector<Value> items;
    if (several)
      items.assign(value.items().begin(), value.items().end());
    else
      items.push_back(value);
    written_as_several_ = several;
    if (!check_types(items)) return std::nullopt;
    bool right = check_count(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Place place{i, items.size()};
      right = check_word(items[i], place) && check_bounds(items[i], place) && right;
    }
    if (!right) return std::nullopt;
    return page_.holds_many() ? Value::tuple(std::move(items)) : items.front();
  }

 private:
  /// Which of how many values.
  struct Place {
    std::size_t index = 0, count = 1;
  };
  Span span_at(const Place& place) const {
    return written_as_several_ ? item_span(span_, place.index, place.count) : span_;
  }

  void error(std::string code, std::string message, const Span& span, std::string hint = {}) {
    context_.diagnostics.error(std::move(code), std::move(message), span, std::move(hint));
  }

  /// Converts in place; stops at the first element of a wrong type, for the others are likely to be wrong alike.
  bool check_types(std::vector<Value>& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      Value& item = items[i];
      if (item.is_unknown()) continue;
      const auto converted = convert_any(item);
      if (!converted) {
        report_type(item, {i, items.size()});
        return false;
      }
      if (converted->is_real() && !std::isfinite(converted->as_real())) {
        error("out-of-bounds", fmt::format("{} wants a finite number, not {}", label_, item.repr()),
              span_at({i, items.size()}), "give a value");
        return false;
      }
      item = *converted;
    }
    return true;
  }

  std::optional<Value> convert_any(const Value& item) const {
    for (const TypePage& type : page_.types)
      if (auto converted = convert(item, type, context_.catalogue)) return converted;
    return std::nullopt;
  }

  void report_type(const Value& item, const Place& place) {
    const bool wrong_concept = item.is_concept() && admits(page_, Kind::concept_kind);
    error(wrong_concept ? "wrong-concept-type" : "wrong-type",
          fmt::format("{} wants {}, not {}", label_, describe_types(page_, context_.catalogue),
                      describe_value(item, context_.catalogue)),
          span_at(place), type_hint(item));
  }

  std::string type_hint(const Value& item) const {
    if (item.is_real() && admits(page_, Kind::integer)) return "write it without a decimal point";
    if (item.as_object<ArrayObject>() != nullptr)
      return "a keyword takes an array of one dimension: flatten() makes it one";
    if (item.is_factor()) return label_ + " is a simple keyword: give it a value, without _F(...)";
    if (item.is_number() && holds_text(page_.types.front().kind)) return "put it between quotes";
    const bool wants_number = admits(page_, Kind::real) || admits(page_, Kind::integer);
    if (wants_number && item.is_text() && is_number(item.as_text())) return "leave out the quotes";
    if (const auto* command = item.as_object<CommandObject>()) return fmt::format("call it: {}(...)", command->name);
    return producers_hint();
  }

  /// Which commands make what is wanted.
  std::string producers_hint() const {
    constexpr std::size_t most_named = 4;
    std::vector<std::string> makers;
    for (const TypePage& type : page_.types) {
      if (type.kind != Kind::concept_kind || type.concept_type == "any") continue;
      for (const std::string& command : context_.catalogue.names())
        for (const ProductPage& product : context_.catalogue.page(command).products)
          if (context_.catalogue.is_a(product.type, type.concept_type) &&
              std::ranges::find(makers, command) == makers.end())
            makers.push_back(command);
    }
    if (makers.empty()) return "";
    if (makers.size() > most_named) makers.resize(most_named);
    return fmt::format("made by {}", fmt::join(makers, ", "));
  }

  bool check_count(std::size_t count) {
    const bool enough = count >= static_cast<std::size_t>(page_.min_count);
    const bool fits = page_.max_count == unlimited || count <= static_cast<std::size_t>(page_.max_count);
    if (enough && fits) return true;
    error("wrong-count",
          fmt::format("{} wants {}, not {}", label_, describe_count(page_.min_count, page_.max_count, "value"), count),
          span_);
    return false;
  }

  bool check_word(const Value& item, const Place& place) {
    if (page_.words.empty() || item.is_unknown() || item.is_concept()) return true;
    const auto word =
        std::ranges::find_if(page_.words, [&](const WordPage& known) { return same_word(item, known.value); });
    if (word == page_.words.end()) {
      report_word(item, place);
      return false;
    }
    if (!word->supported)
      context_.report_unsupported(fmt::format("comma does not support {}={} yet", label_, item.repr()), span_at(place));
    return true;
  }

  /// The keyword beside this one that knows the word.
  std::string other_keyword_with(const std::string& word) const {
    if (context_.level == nullptr) return {};
    for (const KeywordPage& keyword : context_.level->keywords) {
      const auto knows = [&](const WordPage& known) { return known.value.is_text() && known.value.as_text() == word; };
      if (&keyword != &page_ && !keyword.is_factor() && keyword.words.size() > 2 &&
          std::ranges::any_of(keyword.words, knows))
        return keyword.name;
    }
    return {};
  }

  void report_word(const Value& item, const Place& place) {
    constexpr std::size_t most_listed = 12;
    std::vector<std::string> known, shown;
    for (const WordPage& word : page_.words) {
      if (word.value.is_text()) known.push_back(word.value.as_text());
      shown.push_back(word.value.repr());
    }
    const std::string near = item.is_text() ? nearest(item.as_text(), known) : "";
    const std::string former = item.is_text() ? of_former_field(item.as_text()) : "";
    std::string hint;
    if (const std::string home = item.is_text() ? other_keyword_with(item.as_text()) : ""; !home.empty()) {
      hint = fmt::format("it is one of {}", home);
    } else if (std::ranges::find(known, former) != known.end()) {
      hint = fmt::format("it is called '{}' now", former);
    } else if (!near.empty()) {
      hint = fmt::format("did you mean '{}'?", near);
    } else {
      const bool cut = shown.size() > most_listed;
      if (cut) shown.resize(most_listed);
      hint = fmt::format("one of {}{}", fmt::join(shown, ", "), cut ? ", ..." : "");
    }
    error("unknown-word", fmt::format("{} does not know {}", label_, item.repr()), span_at(place), hint);
  }

  bool check_bounds(const Value& item, const Place& place) {
    if (item.is_integer() && admits(page_, Kind::integer) && !page_.bounds.at_most && !fits(item)) {
      error("out-of-bounds", fmt::format("{} must be an integer of 32 bits; it is {}", label_, item.repr()),
            span_at(place), fmt::format("{} at most", most_counted));
      return false;
    }
    if (!item.is_number() || within(item.as_real(), page_.bounds)) return true;
    error("out-of-bounds", fmt::format("{} must be {}; it is {}", label_, describe_bounds(page_.bounds), item.repr()),
          span_at(place));
    return false;
  }

  const KeywordPage& page_;
  const std::string& label_;
  const Span& span_;
  CheckContext& context_;
  bool written_as_several_ = false;
};

}  // namespace

void CheckContext::report_unsupported(std::string message, const Span& span) {
  met_unsupported = true;
  if (!quiet) diagnostics.add({unsupported, "unsupported", std::move(message), without, span});
}

std::optional<Value> check_value(const Value& value, const KeywordPage& page, const std::string& label,
                                 const Span& span, CheckContext& context) {
  return ValueCheck(page, label, span, context).run(value);
}

std::string describe_types(const KeywordPage& page, const Catalogue& catalogue) {
  std::vector<std::string> shown;
  for (const TypePage& type : page.types) shown.push_back(describe_type(type, catalogue));
  if (shown.size() < 2) return shown.empty() ? "" : shown.front();
  const std::string last = std::move(shown.back());
  shown.pop_back();
  return fmt::format("{} or {}", fmt::join(shown, ", "), last);
}

std::string describe_bounds(const Bounds& bounds) {
  std::vector<std::string> parts;
  if (bounds.above) parts.push_back(fmt::format("above {:g}", *bounds.above));
  if (bounds.at_least) parts.push_back(fmt::format("at least {:g}", *bounds.at_least));
  if (bounds.below) parts.push_back(fmt::format("below {:g}", *bounds.below));
  if (bounds.at_most) parts.push_back(fmt::format("at most {:g}", *bounds.at_most));
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string describe_count(int min_count, int max_count, std::string_view noun) {
  const auto counted = [&](int count) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); };
  if (max_count == unlimited) return "at least " + counted(min_count);
  if (min_count == max_count) return counted(max_count);
  return fmt::format("{} to {}", min_count, counted(max_count));
}

}  // namespace comma::interpreter
